// State: after a swap under the shim, GL and EGL state and errors are the same as without it.
#include <gtest/gtest.h>

#include <algorithm>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

struct Case {
  const char* api;
  const char* readback;
};

class WholeState : public ::testing::TestWithParam<Case> {};

TEST_P(WholeState, IsAsWithoutTheShim) {
  const ProcessResult without = run_process({TILEPRESS_STATE_SNAPSHOT, GetParam().api}, {{"LD_PRELOAD", ""}});
  ShimTest test;
  const ShimRun with =
      test.run({TILEPRESS_STATE_SNAPSHOT, GetParam().api}, {{"TILEPRESS_READBACK", GetParam().readback}});
  EXPECT_TRUE(without.exited_with(0)) << without.err;
  EXPECT_TRUE(with.process.exited_with(0));
  EXPECT_GT(std::count(without.out.begin(), without.out.end(), '\n'), 600)
      << "too few states to mean anything";
  EXPECT_NE(without.out.find("pending error 0x500 then 0x0"), std::string::npos);
  const auto difference =
      std::mismatch(without.out.begin(), without.out.end(), with.process.out.begin(), with.process.out.end());
  EXPECT_EQ(with.process.out, without.out)
      << "first difference: "
      << std::string(difference.second, std::find(difference.second, with.process.out.end(), '\n'));
  ASSERT_EQ(with.runs.size(), 1u) << with.log;
  ASSERT_EQ(with.runs[0].frames.size(), 3u) << with.log;
  for (unsigned frame = 0; frame < 3; ++frame)
    EXPECT_EQ(test.dump(0, frame), expected_picture(frame, 33, 21, true)) << "frame " << frame;
}

/// Framebuffer objects are read in the program's context, with all state that the program has set.
TEST_P(WholeState, IsAsWithoutTheShimWhereFramebufferObjectsAreRead) {
  const std::vector<std::string> command = {TILEPRESS_STATE_SNAPSHOT, GetParam().api, "finish"};
  const ProcessResult without = run_process(command, {{"LD_PRELOAD", ""}});
  ShimTest test;
  const ShimRun with = test.run(command, {{"TILEPRESS_READBACK", GetParam().readback},
                                          {"TILEPRESS_TRIGGER", "finish"},
                                          {"TILEPRESS_TARGETS", "all"},
                                          {"LD_PRELOAD", TILEPRESS_PRELOAD_GL}});
  EXPECT_TRUE(with.process.exited_with(0));
  const auto difference =
      std::mismatch(without.out.begin(), without.out.end(), with.process.out.begin(), with.process.out.end());
  EXPECT_EQ(with.process.out, without.out)
      << "first difference: "
      << std::string(difference.second, std::find(difference.second, with.process.out.end(), '\n'));
  ASSERT_EQ(with.runs.size(), 1u) << with.log;
  const bool sized = std::string(GetParam().readback) != "in-context" || std::string(GetParam().api) == "gl";
  // Three swaps and three calls of glFinish, the first on the framebuffer object, which is also a target.
  // With OpenGL ES the shim queries a texture's size in a private context.
  EXPECT_EQ(with.runs[0].frames.size(), sized ? 7u : 5u) << with.log;
  EXPECT_EQ(with.runs[0].json_number("seen"), 6);
}

INSTANTIATE_TEST_SUITE_P(State, WholeState,
                         ::testing::Values(Case{"es2", "sync"}, Case{"es3", "sync"}, Case{"gl", "sync"},
                                           Case{"es2", "async"}, Case{"es3", "async"}, Case{"gl", "async"},
                                           Case{"es2", "in-context"}, Case{"es3", "in-context"},
                                           Case{"gl", "in-context"}),
                         [](const auto& test) {
                           std::string name = std::string(test.param.api) + "_" + test.param.readback;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace tilepress::testing
