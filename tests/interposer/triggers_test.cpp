// Triggers: headless programs, whose frames end with a GL call and come from the bound framebuffer.
#include <gtest/gtest.h>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

constexpr unsigned kFrames = 4;

struct Case {
  const char* api;
  const char* call;
  Road road;
};

class Trigger : public ::testing::TestWithParam<Case> {};

TEST_P(Trigger, TakesTheFramebufferObjectThatIsBound) {
  ShimTest test(GetParam().road);
  const std::vector<std::string> command = {TILEPRESS_FRAMEBUFFER_SCENES, GetParam().api, GetParam().call};
  const ShimRun run = test.run(command, {{"TILEPRESS_TRIGGER", GetParam().call}});
  EXPECT_TRUE(run.process.exited_with(0));
  EXPECT_EQ(run.process.out, "error 0x0, EGL error 0x3000\n");
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  ASSERT_EQ(run.runs[0].frames.size(), kFrames) << run.log;
  EXPECT_EQ(run.runs[0].json_number("seen"), kFrames);
  for (unsigned frame = 0; frame < kFrames; ++frame) {
    EXPECT_EQ(run.runs[0].frames[frame].at("format"), "RGBA8");
    EXPECT_EQ(run.runs[0].presents[frame].at("cause"), GetParam().call);
    EXPECT_EQ(test.dump(0, frame), expected_picture(frame, 40, 24, true)) << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Calls, Trigger,
    ::testing::Values(Case{"es2", "finish", Road::kPreload}, Case{"es3", "flush", Road::kPreload},
                      Case{"gl", "readpixels", Road::kPreload}, Case{"es3", "readpixels", Road::kGlvnd},
                      Case{"gl", "finish", Road::kGlvnd}, Case{"es2", "flush", Road::kBoth},
                      Case{"es3", "finish", Road::kBoth}),
    [](const auto& test) {
      const char* road = test.param.road == Road::kPreload ? "Preload"
                         : test.param.road == Road::kGlvnd ? "Glvnd"
                                                           : "Both";
      return std::string(test.param.api) + "_" + test.param.call + "_" + road;
    });

TEST(Triggers, TakeThePbufferOfAProgramThatNeverSwaps) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_FRAMEBUFFER_SCENES, "es2", "pbuffer"},
                               {{"TILEPRESS_TRIGGER", "readpixels,finish"}});
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  ASSERT_EQ(run.runs[0].frames.size(), kFrames);
  for (unsigned frame = 0; frame < kFrames; ++frame)
    EXPECT_EQ(test.dump(0, frame), expected_picture(frame, 33, 21, true)) << "frame " << frame;
}

TEST(Triggers, AreOffUnlessAskedFor) {
  for (const char* call : {"finish", "flush", "readpixels"}) {
    ShimTest test(Road::kBoth);
    const ShimRun run = test.run({TILEPRESS_FRAMEBUFFER_SCENES, "es3", call}, {{"TILEPRESS_TRIGGER", ""}});
    EXPECT_TRUE(run.process.exited_with(0));
    EXPECT_TRUE(run.runs.empty()) << call;
  }
}

}  // namespace
}  // namespace tilepress::testing
