// Process end: however a program ends, its run has the rows of all frames, or counts the missing ones.
#include <gtest/gtest.h>
#include <signal.h>

#include <map>
#include <string>
#include <vector>

#include "shim_process.h"
#include "tilepress/run_reader.h"

namespace tilepress::testing {
namespace {

/// Runs a program that presents `frames` frames and ends in `way`. `wrapper` stands before the command.
ShimRun end_in(ShimTest& test, const std::string& way, int frames, std::vector<std::string> wrapper = {},
               std::map<std::string, std::string> environment = {}) {
  wrapper.insert(wrapper.end(), {TILEPRESS_PROCESS_END, std::to_string(frames), way});
  environment.try_emplace("TILEPRESS_LOG_LEVEL", "debug");
  return test.run(wrapper, std::move(environment));
}

void expect_whole(const ShimRun& run, size_t frames, const std::string& what) {
  ASSERT_EQ(run.runs.size(), 1u) << what << run.log;
  EXPECT_EQ(run.runs[0].frames.size(), frames) << what << run.log;
  EXPECT_EQ(run.runs[0].json_number("seen"), static_cast<int64_t>(frames)) << what;
  EXPECT_EQ(run.runs[0].json_number("captured"), static_cast<int64_t>(frames)) << what;
}

/// Returns true where the shim can have no task, for instance in a sandbox around the tests.
bool on_a_thread(const ShimRun& run) {
  return run.log.find("compressed on a thread") != std::string::npos;
}

class EndWithoutExit : public ::testing::TestWithParam<Road> {};

TEST_P(EndWithoutExit, LosesNoFrame) {
  for (const char* way : {"raw", "raw-thread", "exec"}) {
    for (const int frames : {1, 3, 10}) {
      ShimTest test(GetParam());
      const ShimRun run = end_in(test, way, frames);
      if (on_a_thread(run)) GTEST_SKIP() << run.log;
      EXPECT_TRUE(run.process.exited_with(7)) << way << run.process.status;
      EXPECT_EQ(run.process.err, "") << way;
      expect_whole(run, static_cast<size_t>(frames), way);
      EXPECT_EQ(run.runs[0].json_text("state"), "ended") << way;
    }
  }
}

TEST_P(EndWithoutExit, BySignalLosesNoFrameEither) {
  const std::map<std::string, int> ways = {
      {"kill", SIGKILL}, {"kill-group", SIGKILL}, {"abort", SIGABRT}, {"crash", SIGSEGV}};
  for (const auto& [way, signal] : ways) {
    ShimTest test(GetParam());
    const ShimRun run = end_in(test, way, 6);
    if (on_a_thread(run)) GTEST_SKIP() << run.log;
    EXPECT_TRUE(run.process.killed_by(signal)) << way << run.process.status;
    expect_whole(run, 6, way);
  }
}
INSTANTIATE_TEST_SUITE_P(ProcessEnd, EndWithoutExit, ::testing::Values(Road::kPreload, Road::kGlvnd));

// At the first read Mesa registers an exit handler that frees what glReadPixels needs.
TEST(ProcessEnd, FramesPresentedByExitHandlersAndDestructorsAreCountedAndNotRead) {
  for (const char* way : {"handler", "destructor"}) {
    ShimTest test;
    const ShimRun run = end_in(test, way, 4);
    EXPECT_TRUE(run.process.exited_with(7)) << way << run.process.status;
    ASSERT_EQ(run.runs.size(), 1u) << way << run.log;
    EXPECT_EQ(run.runs[0].frames.size(), 4u) << way;
    EXPECT_EQ(run.runs[0].json_number("seen"), 5) << way;
    EXPECT_EQ(run.runs[0].json_number("captured"), 4) << way;
    EXPECT_EQ(run.runs[0].json_number("not_captured"), 1) << way;
    EXPECT_EQ(run.runs[0].json_text("state"), "finished") << way;
  }
}

TEST(ProcessEnd, TheProgramMayChangeItsUserAndHasNoStrangeChild) {
  for (const char* way : {"setuid", "wait"}) {
    ShimTest test;
    const ShimRun run = end_in(test, way, 4);
    EXPECT_TRUE(run.process.exited_with(7)) << way << run.process.status;
    expect_whole(run, 4, way);
  }
}

// The program's threads count in a shared page, and the run folder exists before the first present.
TEST(ProcessEnd, WithoutATaskTheFramesThatAreLostAreCounted) {
  for (const char* way : {"raw", "kill", "exec"}) {
    ShimTest test;
    const ShimRun run =
        end_in(test, way, 40, {},
               {{"LD_PRELOAD", TILEPRESS_PRELOAD ":/none/vgpreload_"}, {"TILEPRESS_QUEUE", "64"}});
    EXPECT_TRUE(on_a_thread(run)) << run.log;
    ASSERT_EQ(run.runs.size(), 1u) << way;
    auto read = read_run(run.runs[0].path);
    ASSERT_TRUE(read) << read.error().text;
    RunRecord& record = *read;
    const auto closed = close_run(RunEnd{}, record);
    ASSERT_TRUE(closed) << closed.error().text;
    EXPECT_EQ(record.counts.seen, 40u) << way;
    EXPECT_EQ(record.counts.captured, record.frames.size()) << way;
    EXPECT_EQ(record.counts.not_captured, 40u - record.frames.size()) << way;
  }
}

class ProgramUnder : public ::testing::TestWithParam<const char*> {};

TEST_P(ProgramUnder, AnotherPreloadedLibraryEndsAsWithout) {
  const std::string name = GetParam();
  std::vector<std::string> wrapper = {name};
  if (name == "faketime") wrapper.push_back("2020-01-01 00:00:00");
  if (name == "jemalloc.sh")
    wrapper = {"env", std::string("LD_PRELOAD=") + TILEPRESS_PRELOAD + ":libjemalloc.so.2"};
  for (const Road road : {Road::kPreload, Road::kGlvnd}) {
    if (road == Road::kGlvnd && name == "jemalloc.sh") wrapper.back() = "LD_PRELOAD=libjemalloc.so.2";
    for (int round = 0; round < 4; ++round) {
      ShimTest test(road);
      const ShimRun run = end_in(test, "return", 6, wrapper);
      EXPECT_TRUE(run.process.exited_with(7)) << name << run.process.status << run.process.err;
      EXPECT_EQ(run.process.err, "") << name;
      expect_whole(run, 6, name);
      EXPECT_EQ(run.runs[0].json_text("state"), "finished") << name;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(ProcessEnd, ProgramUnder, ::testing::Values("faketime", "fakeroot", "jemalloc.sh"));

// The address sanitizer's runtime replaces the allocator, memory functions and pthread_create.
TEST(ProcessEnd, AProgramWithTheAddressSanitizerIsCapturedThroughTheSecondRoad) {
  for (const char* way : {"return", "raw"}) {
    ShimTest test(Road::kGlvnd);
    const ShimRun run =
        test.run({TILEPRESS_PROCESS_END_ASAN, "6", way}, {{"ASAN_OPTIONS", "detect_leaks=0"}});
    EXPECT_TRUE(run.process.exited_with(7)) << run.process.err;
    expect_whole(run, 6, way);
  }
}

}  // namespace
}  // namespace tilepress::testing
