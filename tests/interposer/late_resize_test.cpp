// Late resize: a window whose size changes between drawing and presenting looks as it does without the shim.
#include <gtest/gtest.h>

#include <algorithm>

#include "shim_process.h"

namespace tilepress::testing {
namespace {

class LateResize : public ::testing::TestWithParam<const char*> {};

TEST_P(LateResize, ShowsWhatItShowsWithoutTheShim) {
  const std::string api = GetParam();
  const std::map<std::string, std::string> bare = {{"LD_PRELOAD", ""}, {"DISPLAY", own_display()}};
  const ProcessResult without = run_process({TILEPRESS_LATE_RESIZE, api}, bare);
  ASSERT_TRUE(without.exited_with(0));
  ASSERT_EQ(run_process({TILEPRESS_LATE_RESIZE, api}, bare).out, without.out);
  for (const std::string readback : {"auto", "sync", "async", "in-context"}) {
    ShimTest test;
    const ShimRun run = test.run({TILEPRESS_LATE_RESIZE, api},
                                 {{"DISPLAY", own_display()}, {"TILEPRESS_READBACK", readback}});
    EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
    EXPECT_EQ(run.process.out, without.out) << readback;
    ASSERT_EQ(run.runs.size(), 1u);
    ASSERT_EQ(run.runs[0].presents.size(), 12u) << readback;
    for (size_t i = 0; i < 12; ++i) {
      const auto& present = run.runs[0].presents[i];
      EXPECT_EQ(present.at("surface"), std::to_string(i / 3)) << readback << i;
      EXPECT_EQ(present.at("readback") == "in-context", i % 3 == 0 || readback != "async") << readback << i;
    }
  }
}

/// After a trigger the next frame continues in the same buffer.
TEST_P(LateResize, ShowsWhatItShowsWithoutTheShimAfterATrigger) {
  const std::vector<std::string> command = {TILEPRESS_LATE_RESIZE, GetParam(), "finish"};
  const ProcessResult without = run_process(command, {{"LD_PRELOAD", ""}, {"DISPLAY", own_display()}});
  ShimTest test;
  const ShimRun run = test.run(
      command,
      {{"DISPLAY", own_display()}, {"TILEPRESS_TRIGGER", "finish"}, {"TILEPRESS_READBACK", "async"}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  EXPECT_EQ(run.process.out, without.out);
  ASSERT_EQ(run.runs.size(), 1u);
  ASSERT_EQ(run.runs[0].presents.size(), 24u);
  for (size_t i = 0; i < 24; ++i)
    EXPECT_EQ(run.runs[0].presents[i].at("readback"), i % 2 == 0 || i % 6 == 1 ? "in-context" : "async") << i;
}

TEST(Surfaces, NoFrameOfAWindowThatIsPulledAtIsEmpty) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_LATE_RESIZE, "glx", "pulled"},
                               {{"DISPLAY", own_display()}, {"TILEPRESS_SCHEME", "red"}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  ASSERT_EQ(run.runs.size(), 1u);
  ASSERT_EQ(run.runs[0].presents.size(), 400u);
  EXPECT_GT(std::stoul(run.runs[0].presents.back().at("surface")), 20u);
  for (const auto& present : run.runs[0].presents) {
    const std::vector<uint8_t> bytes =
        test.dump(static_cast<uint32_t>(std::stoul(present.at("surface"))), std::stoul(present.at("frame")));
    EXPECT_TRUE(
        std::any_of(bytes.begin(), bytes.end(), [](uint8_t byte) { return byte != 0 && byte != 255; }))
        << present.at("surface") << '-' << present.at("frame");
  }
}

INSTANTIATE_TEST_SUITE_P(Surfaces, LateResize, ::testing::Values("egl", "glx"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace tilepress::testing
