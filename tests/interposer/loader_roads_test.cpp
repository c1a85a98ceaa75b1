// Loader roads: however a program reaches its presenting call, every frame is captured once, pixel by pixel.
#include <gtest/gtest.h>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

constexpr int kFrames = 5;
constexpr int kWidth = 67, kHeight = 45;  // not multiples of the block or of four bytes

/// Every frame of the one run is there once and holds the known picture, behind `extra` frames of a toolkit's
/// own.
void expect_known_frames(const ShimTest& test, const ShimRun& run, bool with_alpha, const char* api,
                         int extra = 0) {
  const int frames = kFrames + extra;
  ASSERT_EQ(run.runs.size(), 1u) << run.log << run.process.err;
  const CapturedRun& captured = run.runs[0];
  ASSERT_EQ(captured.frames.size(), static_cast<size_t>(frames)) << run.log;
  EXPECT_EQ(captured.schemes.size(), static_cast<size_t>(2 * frames));
  EXPECT_EQ(captured.json_text("state"), "finished");
  EXPECT_EQ(captured.json_text("via"), "preload");
  EXPECT_EQ(captured.json_text("api"), api);
  EXPECT_EQ(captured.json_number("seen"), frames);
  EXPECT_EQ(captured.json_number("captured"), frames);
  for (int frame = 0; frame < frames; ++frame) {
    const auto& row = captured.frames[static_cast<size_t>(frame)];
    EXPECT_EQ(row.at("frame"), std::to_string(frame));
    EXPECT_EQ(row.at("width"), std::to_string(kWidth));
    EXPECT_EQ(row.at("height"), std::to_string(kHeight));
    EXPECT_EQ(row.at("format"), with_alpha ? "RGBA8" : "RGBX8");
    if (frame < extra) continue;
    EXPECT_EQ(test.dump(0, static_cast<uint64_t>(frame)),
              expected_picture(static_cast<unsigned>(frame - extra), kWidth, kHeight, with_alpha))
        << "frame " << frame;
  }
}

std::vector<std::string> picture_command(std::vector<std::string> command) {
  command.insert(command.end(), {std::to_string(kFrames), std::to_string(kWidth), std::to_string(kHeight)});
  return command;
}

TEST(LoaderRoads, ALinkedProgramIsCaptured) {
  ShimTest test;
  const ShimRun run = test.run(picture_command({TILEPRESS_EGL_LINKED, "link"}));
  EXPECT_TRUE(run.process.exited_with(0));
  EXPECT_EQ(run.process.out, "error after the last swap: 0x3000\n");
  EXPECT_EQ(run.process.err, "");
  expect_known_frames(test, run, true, "EGL");
}

class OpenedLibrary : public ::testing::TestWithParam<const char*> {};

TEST_P(OpenedLibrary, IsCaptured) {
  ShimTest test;
  const ShimRun run = test.run(picture_command({TILEPRESS_EGL_OPENED, GetParam()}));
  EXPECT_TRUE(run.process.exited_with(0));
  EXPECT_EQ(run.process.out, "error after the last swap: 0x3000\n");
  expect_known_frames(test, run, true, "EGL");
}
INSTANTIATE_TEST_SUITE_P(LoaderRoads, OpenedLibrary,
                         ::testing::Values("local", "deepbind", "getproc", "dlvsym"));

TEST(LoaderRoads, APluginLinkedToEglIsCaptured) {
  ShimTest test;
  const ShimRun run = test.run(picture_command({TILEPRESS_PLUGIN_HOST, TILEPRESS_EGL_PLUGIN, "link"}));
  EXPECT_TRUE(run.process.exited_with(0));
  expect_known_frames(test, run, true, "EGL");
}

TEST(LoaderRoads, ALinkedGlxProgramIsCaptured) {
  ShimTest test;
  const ShimRun run = test.run(picture_command({TILEPRESS_GLX_LINKED}), {{"DISPLAY", own_display()}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  EXPECT_EQ(run.process.out, "error after the last swap: 0x0\n");
  expect_known_frames(test, run, false, "GLX");
}

// GLFW clears a new window to black and presents that before the program draws.
constexpr int kGlfwFrames = 1;

TEST(LoaderRoads, AGlfwWindowWithAnEglContextIsCaptured) {
  ShimTest test;
  const ShimRun run = test.run(picture_command({TILEPRESS_GLFW, "egl"}), {{"DISPLAY", own_display()}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  expect_known_frames(test, run, false, "EGL", kGlfwFrames);
}

TEST(LoaderRoads, AGlfwWindowWithAGlxContextIsCaptured) {
  ShimTest test;
  const ShimRun run = test.run(picture_command({TILEPRESS_GLFW, "glx"}), {{"DISPLAY", own_display()}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  expect_known_frames(test, run, false, "GLX", kGlfwFrames);
}

TEST(LoaderRoads, TheSessionFolderTellsWhichRoadsWereTaken) {
  ShimTest test;
  const ShimRun run = test.run(picture_command({TILEPRESS_EGL_OPENED, "getproc"}));
  const std::vector<std::string> expected = {"egl_opened eglGetProcAddress dlsym",
                                             "egl_opened eglSwapBuffers getprocaddress"};
  EXPECT_EQ(run.seen, expected);
}

}  // namespace
}  // namespace tilepress::testing
