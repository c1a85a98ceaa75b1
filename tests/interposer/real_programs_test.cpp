// Real programs: Debian's own GL programs, unmodified.
#include <gtest/gtest.h>

#include "shim_process.h"

namespace tilepress::testing {
namespace {

void expect_all_frames(const ShimRun& run, const char* width, const char* height) {
  ASSERT_EQ(run.runs.size(), 1u) << run.log << run.process.err;
  const CapturedRun& captured = run.runs[0];
  EXPECT_GT(captured.frames.size(), 0u);
  EXPECT_EQ(captured.json_number("captured"), captured.json_number("seen")) << run.log;
  for (const auto& row : captured.frames) {
    EXPECT_EQ(row.at("width"), width);
    EXPECT_EQ(row.at("height"), height);
  }
}

TEST(RealPrograms, Glmark2Es2FindsEglByDlsym) {
  ShimTest test;
  const ShimRun run = test.run({"glmark2-es2", "--size", "360x640", "-b", "desktop:duration=1"},
                               {{"DISPLAY", own_display()}, {"TILEPRESS_VERIFY", "1"}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  expect_all_frames(run, "360", "640");
  EXPECT_EQ(static_cast<int64_t>(run.runs[0].frames.size()), run.runs[0].json_number("seen"));
}

TEST(RealPrograms, EachFrameIsCapturedOrCountedAsDropped) {
  ShimTest test;
  const ShimRun run = test.run({"glmark2-es2", "--size", "360x640", "-b", "desktop:duration=1"},
                               {{"DISPLAY", own_display()},
                                {"TILEPRESS_ON_FULL", "drop"},
                                {"TILEPRESS_QUEUE", "1"},
                                {"TILEPRESS_SCHEME", "lcc vdcp:fvc={16..512} vdcp:policy=lru,fvc={16..512}"},
                                {"TILEPRESS_VERIFY", "1"}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  ASSERT_EQ(run.runs.size(), 1u) << run.log << run.process.err;
  const CapturedRun& captured = run.runs[0];
  EXPECT_EQ(captured.json_number("captured") + captured.json_number("dropped"), captured.json_number("seen"));
  EXPECT_EQ(static_cast<int64_t>(captured.frames.size()), captured.json_number("captured"));
  EXPECT_EQ(captured.frames.at(0).at("frame"), "0");
}

TEST(RealPrograms, Glmark2FindsGlxByDlsym) {
  ShimTest test;
  const ShimRun run =
      test.run({"glmark2", "--size", "320x240", "-b", "build:duration=1"}, {{"DISPLAY", own_display()}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  expect_all_frames(run, "320", "240");
}

// Ends the program once 20 frames are written, however long a loaded machine takes.
constexpr const char* kEndAfterTwentyFrames =
    "\"$0\" > /dev/null & program=$!; i=0\n"
    "while [ $i -lt 800 ] && [ $(cat \"$TILEPRESS_OUT\"/*/frames.csv 2> /dev/null | wc -l) -lt 21 ]; do\n"
    "  sleep 0.1; i=$((i + 1))\n"
    "done\n"
    "kill $program; wait $program";

TEST(RealPrograms, TheGearsAreLinkedAndEndByASignal) {
  for (const char* program : {"glxgears", "es2gears_x11"}) {
    ShimTest test;
    const ShimRun run = test.run({"sh", "-c", kEndAfterTwentyFrames, program},
                                 {{"DISPLAY", own_display()}, {"TILEPRESS_FRAMES", "0-19"}});
    EXPECT_TRUE(run.process.exited_with(143)) << program << run.process.err;
    ASSERT_EQ(run.runs.size(), 1u) << program;
    EXPECT_EQ(run.runs[0].frames.size(), 20u) << program;
    EXPECT_EQ(run.runs[0].frames[0].at("width"), "300");
  }
}

}  // namespace
}  // namespace tilepress::testing
