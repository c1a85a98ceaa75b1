// Async readback: pixel buffers give the same frames. Each comes once, in order, with every pixel, however
// the program continues or ends.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdio>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

std::map<std::string, std::string> asking_for(const char* readback) {
  return {{"TILEPRESS_READBACK", readback}, {"DISPLAY", own_display()}};
}

/// Returns the presents that were read in `way`.
size_t count_of(const CapturedRun& run, const std::string& way) {
  return static_cast<size_t>(std::count_if(run.presents.begin(), run.presents.end(),
                                           [&](const auto& row) { return row.at("readback") == way; }));
}

struct Sample {
  const char* name;
  std::vector<std::string> command;
  size_t frames;
  size_t async;  ///< of them through pixel buffers; never the first frame of a window at a size
};

const Sample kSamples[] = {
    {"Pbuffer", {TILEPRESS_EGL_OPENED, "local", "20", "67", "45"}, 20, 20},
    {"EglWindow", {TILEPRESS_EGL_DAMAGE}, 3, 2},
    {"EglWindowOfGlfw", {TILEPRESS_GLFW, "egl", "6", "67", "45"}, 7, 6},
    {"GlxWindow", {TILEPRESS_GLX_LINKED, "6", "67", "45"}, 6, 5},
    {"GlxCopies", {TILEPRESS_GLX_PRESENTS, "copy"}, 3, 2},
    {"GlxWindowResized", {TILEPRESS_GLX_RESIZE}, 12, 8},
    {"SurfacesInTurn", {TILEPRESS_EGL_SCENES, "alternate"}, 10, 10},
    {"SurfacesDestroyedAfterTheirLastSwap", {TILEPRESS_EGL_SCENES, "recreate"}, 12, 12},
    {"DisplayTerminated", {TILEPRESS_EGL_SCENES, "terminate"}, 12, 12},
    {"LargeSurfaces", {TILEPRESS_EGL_SCENES, "large"}, 9, 9},
    {"ContextDestroyed", {TILEPRESS_EGL_SCENES, "destroyed"}, 1, 1},
    // Frames of a context that is destroyed while current are read in that context.
    {"GlxContextDestroyed", {TILEPRESS_GLX_PRESENTS, "destroyed"}, 3, 0},
    {"FailedSwaps", {TILEPRESS_EGL_SCENES, "failures"}, 1, 1},
    {"Rgb565", {TILEPRESS_EGL_SCENES, "format", "5", "6", "5", "0", "0"}, 5, 5},
    {"Rgb10a2", {TILEPRESS_EGL_SCENES, "format", "10", "10", "10", "2", "0"}, 5, 5},
    {"Rgbx8", {TILEPRESS_EGL_SCENES, "format", "8", "8", "8", "0", "0"}, 5, 5},
};

class AsyncReadback : public ::testing::TestWithParam<std::tuple<Road, Sample>> {};

TEST_P(AsyncReadback, GivesTheFramesThatSynchronousReadsGive) {
  const auto& [road, sample] = GetParam();
  ShimTest sync_test(road), async_test(road);
  const ShimRun sync = sync_test.run(sample.command, asking_for("sync"));
  const ShimRun async = async_test.run(sample.command, asking_for("async"));
  EXPECT_EQ(async.process.status, sync.process.status);
  EXPECT_EQ(async.process.out, sync.process.out);
  EXPECT_EQ(async.process.err, sync.process.err);
  ASSERT_EQ(sync.runs.size(), 1u) << sync.log;
  ASSERT_EQ(async.runs.size(), 1u) << async.log;
  const CapturedRun &before = sync.runs[0], &after = async.runs[0];
  EXPECT_EQ(count_of(before, "async"), 0u);
  EXPECT_EQ(count_of(after, "async"), sample.async);
  ASSERT_EQ(before.frames.size(), sample.frames) << sync.log;
  ASSERT_EQ(after.frames.size(), sample.frames) << async.log;
  EXPECT_EQ(after.schemes, before.schemes);
  EXPECT_EQ(after.surfaces, before.surfaces);
  for (size_t i = 0; i < sample.frames; ++i) {
    auto rows = {before.frames[i], after.frames[i]};
    std::vector<std::map<std::string, std::string>> untimed(rows);
    for (auto& row : untimed)
      std::erase_if(row, [](const auto& field) { return field.first.ends_with("_ns"); });
    EXPECT_EQ(untimed[1], untimed[0]) << "row " << i;
    const auto surface = static_cast<uint32_t>(std::stoul(untimed[0].at("surface")));
    const uint64_t frame = std::stoul(untimed[0].at("frame"));
    EXPECT_EQ(async_test.dump(surface, frame), sync_test.dump(surface, frame)) << "row " << i;
    EXPECT_FALSE(async_test.dump(surface, frame).empty()) << "row " << i;
  }
  EXPECT_EQ(after.json_number("seen"), before.json_number("seen"));
  EXPECT_EQ(after.json_number("captured"), before.json_number("captured"));
  EXPECT_EQ(after.json_text("state"), "finished");
}

INSTANTIATE_TEST_SUITE_P(Readback, AsyncReadback,
                         ::testing::Combine(::testing::Values(Road::kPreload, Road::kGlvnd),
                                            ::testing::ValuesIn(kSamples)),
                         [](const auto& test) {
                           const Road road = std::get<0>(test.param);
                           return std::string(std::get<1>(test.param).name) +
                                  (road == Road::kPreload ? "Preload" : "Glvnd");
                         });

TEST(Readback, AsynchronousReadsGiveTheKnownPicture) {
  ShimTest test(Road::kBoth);
  const ShimRun run =
      test.run({TILEPRESS_EGL_OPENED, "local", "40", "67", "45"}, {{"TILEPRESS_READBACK", "async"}});
  ASSERT_EQ(run.runs.size(), 1u);
  ASSERT_EQ(count_of(run.runs[0], "async"), 40u) << run.log;
  for (unsigned frame = 0; frame < 40; ++frame) {
    EXPECT_EQ(run.runs[0].frames[frame].at("frame"), std::to_string(frame));
    EXPECT_EQ(test.dump(0, frame), expected_picture(frame, 67, 45, true)) << "frame " << frame;
  }
}

TEST(Readback, ThreadsThatPresentAtOnceMayAllReadAsynchronously) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_EGL_SCENES, "threads"}, {{"TILEPRESS_READBACK", "async"}});
  EXPECT_TRUE(run.process.exited_with(0));
  ASSERT_EQ(run.runs.size(), 1u);
  ASSERT_EQ(count_of(run.runs[0], "async"), 48u) << run.log;
  std::map<std::string, unsigned> next;  // frame, by surface
  for (const auto& row : run.runs[0].frames) {
    const unsigned frame = next[row.at("surface")]++;
    EXPECT_EQ(row.at("frame"), std::to_string(frame));
    EXPECT_EQ(test.dump(static_cast<uint32_t>(std::stoul(row.at("surface"))), frame),
              expected_picture(frame, std::stoi(row.at("width")), std::stoi(row.at("height")), true));
  }
}

class AsyncEnd : public ::testing::TestWithParam<const char*> {};

TEST_P(AsyncEnd, LosesNoFrameAndKeepsItsStatus) {
  for (const Road road : {Road::kPreload, Road::kBoth}) {
    ShimTest test(road);
    const ShimRun run = test.run({TILEPRESS_EGL_OPENED, "local", "20", "320", "200", GetParam()},
                                 {{"TILEPRESS_READBACK", "async"}});
    EXPECT_TRUE(run.process.exited_with(7));
    ASSERT_EQ(run.runs.size(), 1u);
    EXPECT_EQ(run.runs[0].frames.size(), 20u);
    EXPECT_EQ(count_of(run.runs[0], "async"), 20u);
    EXPECT_EQ(test.dump(0, 19), expected_picture(19, 320, 200, true));
    EXPECT_EQ(run.runs[0].json_text("state"), "finished");
  }
}
INSTANTIATE_TEST_SUITE_P(Readback, AsyncEnd, ::testing::Values("exit", "_exit", "_Exit", "quick_exit"));

class AsyncKilled : public ::testing::TestWithParam<const char*> {};

TEST_P(AsyncKilled, LosesNoMoreThanTheQueueHolds) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_EGL_OPENED, "local", "50", "64", "64", GetParam()},
                               {{"TILEPRESS_READBACK", "async"}});
  EXPECT_TRUE(WIFSIGNALED(run.process.status));
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_GE(run.runs[0].frames.size(), 47u);
  for (size_t i = 0; i < run.runs[0].frames.size(); ++i) {
    EXPECT_EQ(run.runs[0].frames[i].at("frame"), std::to_string(i));
    EXPECT_EQ(test.dump(0, i), expected_picture(static_cast<unsigned>(i), 64, 64, true));
  }
}
INSTANTIATE_TEST_SUITE_P(Readback, AsyncKilled, ::testing::Values("term", "kill", "abort"));

TEST(Readback, OfAProgramThatPresentsNoMoreAllFramesCome) {
  ShimTest test;
  // The test kills the program only once the rows exist: nothing is written at the end.
  const ShimRun run = test.run({"sh", "-c",
                                "\"$0\" \"$@\" & for i in $(seq 600); do"
                                " [ \"$(cat \"$TILEPRESS_OUT\"/*/frames.csv 2>/dev/null | wc -l)\" = 6 ] &&"
                                " break; sleep 0.1; done; kill -9 $!; wait $!; exit 5",
                                TILEPRESS_EGL_OPENED, "local", "5", "64", "64", "pause"},
                               {{"TILEPRESS_READBACK", "async"}});
  EXPECT_TRUE(run.process.exited_with(5));
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].frames.size(), 5u);
  EXPECT_EQ(count_of(run.runs[0], "async"), 5u);
}

TEST(Readback, AForkedChildReadsAsynchronouslyOnItsOwn) {
  for (const char* end : {"fork", "fork-after"}) {
    ShimTest test;
    const ShimRun run = test.run({TILEPRESS_EGL_OPENED, "local", "6", "32", "24", end},
                                 {{"LP_NUM_THREADS", "0"}, {"TILEPRESS_READBACK", "async"}});
    EXPECT_TRUE(run.process.exited_with(0));
    ASSERT_EQ(run.runs.size(), 2u) << end;
    const size_t first = count_of(run.runs[0], "async"), second = count_of(run.runs[1], "async");
    EXPECT_EQ(std::min(first, second), 6u) << end;
    EXPECT_EQ(std::max(first, second), 8u) << end;
  }
}

TEST(Readback, AsynchronousReadsOfWindowsMadeAgainAndAgainLeakNothing) {
  for (const char* api : {"egl", "glx"}) {
    const ShimRun run = soak_windows(api, {{"TILEPRESS_READBACK", "async"}});
    ASSERT_EQ(run.runs.size(), 1u);
    EXPECT_EQ(count_of(run.runs[0], "async"), 800u);
  }
}

TEST(Readback, TheFirstFramesOfAWindowDecideAndTheLogSaysHow) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_EGL_OPENED, "local", "40", "67", "45"},
                               {{"TILEPRESS_READBACK", "auto"}, {"TILEPRESS_LOG_LEVEL", "info"}});
  ASSERT_EQ(run.runs.size(), 1u);
  ASSERT_EQ(run.runs[0].presents.size(), 40u);
  for (size_t i = 0; i < 17; ++i)
    EXPECT_EQ(run.runs[0].presents[i].at("readback"), i < 10 ? "sync" : "both") << i;
  const size_t line = run.log.find("surface 0: synchronous reads ");
  ASSERT_NE(line, std::string::npos) << run.log;
  double synchronous = 0, buffered = 0;
  EXPECT_EQ(
      std::sscanf(run.log.c_str() + line, "surface 0: synchronous reads %lf ms, into pixel buffers %lf ms",
                  &synchronous, &buffered),
      2)
      << run.log;
  EXPECT_GT(synchronous, 0);
  EXPECT_GT(buffered, 0);
  for (unsigned frame = 0; frame < 40; ++frame)
    EXPECT_EQ(test.dump(0, frame), expected_picture(frame, 67, 45, true)) << "frame " << frame;
}

TEST(Readback, AWordThatIsNoWayToReadEndsTheRunNotTheProgram) {
  ShimTest test;
  const ShimRun run =
      test.run({TILEPRESS_EGL_OPENED, "local", "3", "32", "24"}, {{"TILEPRESS_READBACK", "pbo"}});
  EXPECT_TRUE(run.process.exited_with(0));
  EXPECT_TRUE(run.runs.empty());
  EXPECT_NE(run.log.find("TILEPRESS_READBACK=pbo: must be auto, sync, async or in-context"),
            std::string::npos)
      << run.log;
}

}  // namespace
}  // namespace tilepress::testing
