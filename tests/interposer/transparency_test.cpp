// Transparency: programs cannot see the shim, and however they end, their frames are kept.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdio>

#include "shim_process.h"

namespace tilepress::testing {
namespace {

const std::map<std::string, std::string> kWithout = {{"LD_PRELOAD", ""}};

std::map<std::string, std::string> with_shim() {
  return {{"LD_PRELOAD", TILEPRESS_PRELOAD}};
}

TEST(Transparency, LookupsGiveWhatTheyGiveWithoutTheShim) {
  const ProcessResult without = run_process({TILEPRESS_LOOKUP_PROBE}, kWithout);
  const ProcessResult with = run_process({TILEPRESS_LOOKUP_PROBE}, with_shim());
  EXPECT_TRUE(without.exited_with(5));
  EXPECT_TRUE(with.exited_with(5));
  EXPECT_NE(without.out.find("egl eglSwapBuffers: found, no error"), std::string::npos) << without.out;
  // The first library returns 10 + the result of the next definition, which is 2.
  EXPECT_NE(without.out.find("next of a library: 12"), std::string::npos) << without.out;
  EXPECT_EQ(with.out, without.out);
  EXPECT_EQ(with.err, without.err);
}

TEST(Transparency, ShellsAndToolsRunAsEver) {
  const std::vector<std::vector<std::string>> commands = {
      {"sh", "-c", "echo out; echo err >&2; exit 3"},
      {"ls", "/"},
      {"ls", "/nonexistent-folder"},
      {"sh", "-c", "kill -9 $$"},
      {"bash", "-c", "(exit 4); echo $?; echo a | cat | tr a b"},
  };
  for (const auto& command : commands) {
    const ProcessResult without = run_process(command, kWithout);
    const ProcessResult with = run_process(command, with_shim());
    EXPECT_EQ(with.status, without.status) << command.back();
    EXPECT_EQ(with.out, without.out) << command.back();
    EXPECT_EQ(with.err, without.err) << command.back();
  }
}

TEST(Transparency, AProgramThatPresentsNothingLeavesNoFolder) {
  ShimTest test;
  EXPECT_TRUE(test.run({"sh", "-c", "ls / > /dev/null"}).runs.empty());
  const ShimRun run = test.run({TILEPRESS_EGL_LINKED, "link", "0", "16", "16"});
  EXPECT_TRUE(run.process.exited_with(0));
  EXPECT_TRUE(run.runs.empty());
}

TEST(Transparency, WithoutAnOutputFolderTheShimOnlyForwards) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_EGL_LINKED, "link", "3", "16", "16"}, {{"TILEPRESS_OUT", ""}});
  EXPECT_TRUE(run.process.exited_with(0));
  EXPECT_EQ(run.process.out, "error after the last swap: 0x3000\n");
}

TEST(Transparency, AnUnwritableOutputFolderDoesNotHarmTheProgram) {
  ShimTest test;
  const ShimRun run =
      test.run({TILEPRESS_EGL_LINKED, "link", "9", "16", "16"}, {{"TILEPRESS_OUT", "/proc/nowhere"}});
  EXPECT_TRUE(run.process.exited_with(0));
  EXPECT_EQ(run.process.out, "error after the last swap: 0x3000\n");
  EXPECT_EQ(run.process.err, "");
  EXPECT_NE(run.log.find("tilepress: /proc/nowhere"), std::string::npos) << run.log;
}

/// Runs `script`, which starts a program that presents 40 frames as "$0" "$@".
ShimRun run_in(ShimTest& test, const char* script, std::map<std::string, std::string> environment = {}) {
  return test.run({"sh", "-c", script, TILEPRESS_EGL_OPENED, "local", "40", "96", "80"},
                  std::move(environment));
}

TEST(Transparency, AVanishedWorkingFolderIsNoMatter) {
  ShimTest test;
  const ShimRun run = run_in(test, "d=$(mktemp -d) && cd $d && rmdir $d && exec \"$0\" \"$@\"");
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].frames.size(), 40u);
}

TEST(Transparency, ClosedStandardStreamsAreNotTakenForTheShimsFiles) {
  ShimTest test;
  const ShimRun run = run_in(test, "exec \"$0\" \"$@\" 2>&- <&-");
  EXPECT_TRUE(run.process.exited_with(0));
  EXPECT_EQ(run.process.out, "error after the last swap: 0x3000\n");
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].frames.size(), 40u);
  for (const auto& row : run.runs[0].frames) EXPECT_EQ(row.count("top100_coverage"), 1u);
}

// The rows of 40 frames exceed the file limit of one kilobyte. Exceeding it also sends a signal.
TEST(Transparency, FilesThatMayNotGrowEndTheRunNotTheProgram) {
  ShimTest test;
  const ShimRun run = run_in(test, "ulimit -f 2; exec \"$0\" \"$@\"", {{"TILEPRESS_DUMP_FRAMES", ""}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.status;
  EXPECT_EQ(run.process.out, "error after the last swap: 0x3000\n");
  EXPECT_EQ(run.process.err, "");
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_LT(run.runs[0].frames.size(), 40u);
}

TEST(Transparency, AFullDiskEndsTheRunNotTheProgram) {
  const ProcessResult able =
      run_process({"unshare", "-rm", "sh", "-c",
                   "d=$(mktemp -d); mount -t tmpfs -o size=16k none $d; s=$?; rmdir $d 2>/dev/null; exit $s"},
                  {});
  if (!able.exited_with(0)) GTEST_SKIP() << "no small file system can be mounted here";
  ShimTest test;
  const ShimRun run = test.run(
      {"unshare", "-rm", "sh", "-c",
       "mkdir -p \"$TILEPRESS_OUT\"; mount -t tmpfs -o size=16k none \"$TILEPRESS_OUT\"; \"$0\" \"$@\"; s=$?;"
       "df --output=avail \"$TILEPRESS_OUT\" | tail -1 >&2; exit $s",
       TILEPRESS_EGL_OPENED, "local", "200", "96", "80"},
      {{"TILEPRESS_DUMP_FRAMES", ""}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  EXPECT_EQ(run.process.out, "error after the last swap: 0x3000\n");
  EXPECT_NE(run.log.find("No space left on device"), std::string::npos) << run.log;
}

TEST(Transparency, AProgramWithMoreRightsIsNotReachedAndDoesNotNotice) {
  std::vector<std::string> command = {"su", "--version"};
  if (geteuid() == 0) {
    const std::vector<std::string> as_another = {"setpriv", "--reuid=65534", "--regid=65534",
                                                 "--clear-groups"};
    command.insert(command.begin(), as_another.begin(), as_another.end());
  }
  const ProcessResult without = run_process(command, kWithout);
  const ProcessResult with = run_process(command, with_shim());
  EXPECT_TRUE(without.exited_with(0)) << without.err;
  EXPECT_EQ(with.status, without.status);
  EXPECT_EQ(with.out, without.out);
  EXPECT_EQ(with.err, without.err);
}

class EndOfProgram : public ::testing::TestWithParam<const char*> {};

TEST_P(EndOfProgram, LosesNoFrameAndKeepsItsStatus) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_EGL_OPENED, "local", "20", "32", "24", GetParam()});
  EXPECT_TRUE(run.process.exited_with(7));
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].frames.size(), 20u);
  EXPECT_EQ(run.runs[0].json_text("state"), "finished");
}
INSTANTIATE_TEST_SUITE_P(Transparency, EndOfProgram,
                         ::testing::Values("exit", "_exit", "_Exit", "quick_exit"));

struct Killing {
  const char* end;
  int signal;
};
class KilledProgram : public ::testing::TestWithParam<Killing> {};

TEST_P(KilledProgram, KeepsTheRowsOfItsFinishedFrames) {
  ShimTest test;
  // On a loaded machine `auto` may choose asynchronous reads. A frame whose read is under way is lost then.
  const ShimRun run = test.run({TILEPRESS_EGL_OPENED, "local", "200", "64", "64", GetParam().end},
                               {{"TILEPRESS_READBACK", "sync"}});
  EXPECT_TRUE(run.process.killed_by(GetParam().signal));
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].frames.size(), 200u) << run.log;
  for (size_t i = 0; i < run.runs[0].frames.size(); ++i) {
    EXPECT_EQ(run.runs[0].frames[i].at("frame"), std::to_string(i));
    EXPECT_EQ(run.runs[0].frames[i].count("top100_coverage"), 1u);
  }
  EXPECT_GE(run.runs[0].schemes.size(), 2 * run.runs[0].frames.size());
}
INSTANTIATE_TEST_SUITE_P(Transparency, KilledProgram,
                         ::testing::Values(Killing{"kill", SIGKILL}, Killing{"abort", SIGABRT},
                                           Killing{"term", SIGTERM}, Killing{"segv", SIGSEGV}),
                         [](const auto& test) { return std::string(test.param.end); });

TEST(Transparency, APresentingProgramMayExecuteAnother) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_EGL_OPENED, "local", "6", "32", "24", "vfork"});
  EXPECT_TRUE(run.process.exited_with(0));
  EXPECT_NE(run.process.out.find("child\n"), std::string::npos);
  EXPECT_EQ(run.process.err, "");
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].frames.size(), 12u);
}

TEST(Transparency, TheGlLibraryMayBeClosedAndOpenedAgain) {
  for (const char* road : {"local", "deepbind"}) {
    ShimTest test;
    const ShimRun run = test.run({TILEPRESS_EGL_OPENED, road, "6", "32", "24", "dlclose"});
    EXPECT_TRUE(run.process.exited_with(0)) << road << run.process.err;
    ASSERT_EQ(run.runs.size(), 1u);
    EXPECT_EQ(run.runs[0].frames.size(), 12u) << road;
  }
}

TEST(Transparency, AForkedChildThatPresentsHasARunOfItsOwn) {
  for (const char* end : {"fork", "fork-after"}) {
    ShimTest test;
    // The driver's threads do not survive a fork, so the driver must draw in the calling thread.
    const ShimRun run =
        test.run({TILEPRESS_EGL_OPENED, "local", "6", "32", "24", end}, {{"LP_NUM_THREADS", "0"}});
    EXPECT_TRUE(run.process.exited_with(0));
    ASSERT_EQ(run.runs.size(), 2u) << end;
    std::vector<size_t> frames = {run.runs[0].frames.size(), run.runs[1].frames.size()};
    EXPECT_EQ(std::min(frames[0], frames[1]), 6u) << end;
    EXPECT_EQ(std::max(frames[0], frames[1]), 8u) << end;
  }
}

TEST(Transparency, SurfacesAndContextsMadeAgainAndAgainLeakNothing) {
  ShimTest test;
  const ShimRun run =
      test.run({TILEPRESS_EGL_SOAK, "1000"},
               {{"TILEPRESS_SCHEME", "vdcp"}, {"TILEPRESS_DUMP_FRAMES", ""}, {"LP_NUM_THREADS", "0"}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  long early_kib = 0, late_kib = 0;
  int early_descriptors = 0, late_descriptors = 1;
  ASSERT_EQ(sscanf(run.process.out.c_str(),
                   "%ld KiB, %d descriptors, %*d threads\n%ld KiB, %d descriptors, %*d threads", &early_kib,
                   &early_descriptors, &late_kib, &late_descriptors),
            4)
      << run.process.out;
  // Ninety sets of surface, context and engine lie between the two. A leak of one frame (11 KiB at least) in
  // each of the 900, or of one context (more than 100 KiB) in each set, would show.
  EXPECT_LT(late_kib - early_kib, 6000) << run.process.out;
  EXPECT_EQ(late_descriptors, early_descriptors);
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].json_number("captured"), 1000);
}

class WindowsMadeAgainAndAgain : public ::testing::TestWithParam<const char*> {};

TEST_P(WindowsMadeAgainAndAgain, LeakNothing) {
  const ShimRun run = soak_windows(GetParam(), {});
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].json_number("captured"), 1600);
}
INSTANTIATE_TEST_SUITE_P(Transparency, WindowsMadeAgainAndAgain, ::testing::Values("egl", "glx"));

TEST(Transparency, OnlyTheFramesAskedForAreTaken) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_EGL_LINKED, "link", "12", "32", "24"},
                               {{"TILEPRESS_FRAMES", "2-9"}, {"TILEPRESS_EVERY", "3"}});
  ASSERT_EQ(run.runs.size(), 1u);
  ASSERT_EQ(run.runs[0].frames.size(), 3u);  // 3, 6 and 9
  EXPECT_EQ(run.runs[0].frames[0].at("frame"), "3");
  EXPECT_EQ(run.runs[0].frames[2].at("frame"), "9");
  EXPECT_EQ(run.runs[0].json_number("seen"), 12);
  EXPECT_EQ(run.runs[0].json_number("skipped"), 9);
}

}  // namespace
}  // namespace tilepress::testing
