// Loader roads: every way to a presenting call gives every frame once, with every pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

constexpr int kFrames = 5;
constexpr int kWidth = 67, kHeight = 45;  // not multiples of a block, nor of four bytes

struct Program {
  const char* name;
  std::vector<std::string> command;
  const char* api;
  bool with_alpha;
  int toolkit_frames;  ///< presented before the program draws
  bool needs_x;
};

const Program kPrograms[] = {
    {"LinkedToEgl", {TILEPRESS_EGL_LINKED, "link"}, "EGL", true, 0, false},
    {"OpensEglLocally", {TILEPRESS_EGL_OPENED, "local"}, "EGL", true, 0, false},
    {"OpensEglDeepBound", {TILEPRESS_EGL_OPENED, "deepbind"}, "EGL", true, 0, false},
    {"AsksGetProcAddressAlone", {TILEPRESS_EGL_OPENED, "getproc"}, "EGL", true, 0, false},
    {"AsksDlvsym", {TILEPRESS_EGL_OPENED, "dlvsym"}, "EGL", true, 0, false},
    {"PluginLinkedToEgl", {TILEPRESS_PLUGIN_HOST, TILEPRESS_EGL_PLUGIN, "link"}, "EGL", true, 0, false},
    {"LinkedToGlx", {TILEPRESS_GLX_LINKED}, "GLX", false, 0, true},
    // GLFW clears a new window to black and presents that before the program draws.
    {"GlfwWithEgl", {TILEPRESS_GLFW, "egl"}, "EGL", false, 1, true},
    {"GlfwWithGlx", {TILEPRESS_GLFW, "glx"}, "GLX", false, 1, true},
    {"Sdl", {TILEPRESS_SDL}, "EGL", true, 0, false},
    {"Epoxy", {TILEPRESS_EPOXY}, "EGL", true, 0, false},
};

const char* via_of(Road road) {
  return road == Road::kGlvnd ? "glvnd" : "preload";
}

ShimRun run_program(ShimTest& test, const Program& program) {
  std::vector<std::string> command = program.command;
  command.insert(command.end(), {std::to_string(kFrames), std::to_string(kWidth), std::to_string(kHeight)});
  // Without an X server SDL draws to pbuffers.
  return test.run(command,
                  {{"DISPLAY", program.needs_x ? own_display() : ""}, {"SDL_VIDEODRIVER", "offscreen"}});
}

/// Expects each presented frame once in the one run. The frames that the program drew hold the known picture.
void expect_known_frames(const ShimTest& test, const ShimRun& run, const Program& program, const char* via) {
  const int frames = kFrames + program.toolkit_frames;
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  ASSERT_EQ(run.runs.size(), 1u) << run.log << run.process.err;
  const CapturedRun& captured = run.runs[0];
  ASSERT_EQ(captured.frames.size(), static_cast<size_t>(frames)) << run.log;
  EXPECT_EQ(captured.schemes.size(), static_cast<size_t>(2 * frames));
  EXPECT_EQ(captured.json_text("state"), "finished");
  EXPECT_EQ(captured.json_text("via"), via);
  EXPECT_EQ(captured.json_text("api"), program.api);
  EXPECT_EQ(captured.json_number("seen"), frames);
  EXPECT_EQ(captured.json_number("captured"), frames);
  for (int frame = 0; frame < frames; ++frame) {
    const auto& row = captured.frames[static_cast<size_t>(frame)];
    EXPECT_EQ(row.at("frame"), std::to_string(frame));
    EXPECT_EQ(row.at("width"), std::to_string(kWidth));
    EXPECT_EQ(row.at("height"), std::to_string(kHeight));
    EXPECT_EQ(row.at("format"), program.with_alpha ? "RGBA8" : "RGBX8");
    const int drawn = frame - program.toolkit_frames;
    if (drawn < 0) continue;
    EXPECT_EQ(test.dump(0, static_cast<uint64_t>(frame)),
              expected_picture(static_cast<unsigned>(drawn), kWidth, kHeight, program.with_alpha))
        << "frame " << frame;
  }
}

class LoaderRoads : public ::testing::TestWithParam<std::tuple<Road, Program>> {};

TEST_P(LoaderRoads, EveryFrameIsCapturedOnceAndRight) {
  const auto& [road, program] = GetParam();
  ShimTest test(road);
  const ShimRun run = run_program(test, program);
  expect_known_frames(test, run, program, via_of(road));
  if (std::string(program.name) == "LinkedToEgl") {
    EXPECT_EQ(run.process.out, "error after the last swap: 0x3000\n");
  } else if (std::string(program.name) == "LinkedToGlx") {
    EXPECT_EQ(run.process.out, "error after the last swap: 0x0\n");
  }
  EXPECT_EQ(run.process.err, "");
}

INSTANTIATE_TEST_SUITE_P(Matrix, LoaderRoads,
                         ::testing::Combine(::testing::Values(Road::kPreload, Road::kGlvnd, Road::kBoth),
                                            ::testing::ValuesIn(kPrograms)),
                         [](const auto& test) {
                           const Road road = std::get<0>(test.param);
                           const char* name = road == Road::kPreload ? "Preload"
                                              : road == Road::kGlvnd ? "Glvnd"
                                                                     : "Both";
                           return std::string(name) + "_" + std::get<1>(test.param).name;
                         });

TEST(LoaderRoadsLimits, ADeepBoundLinkedPluginIsReachedThroughGlvndAlone) {
  const Program program = {
      "", {TILEPRESS_PLUGIN_HOST, "deepbind", TILEPRESS_EGL_PLUGIN, "link"}, "EGL", true, 0, false};
  ShimTest preload(Road::kPreload), glvnd(Road::kGlvnd), both(Road::kBoth);
  EXPECT_TRUE(run_program(preload, program).runs.empty());
  expect_known_frames(glvnd, run_program(glvnd, program), program, "glvnd");
  expect_known_frames(both, run_program(both, program), program, "glvnd");
}

TEST(LoaderRoadsLimits, TheSessionFolderTellsWhichRoadsWereTaken) {
  ShimTest preload(Road::kPreload), both(Road::kBoth);
  const Program& program = kPrograms[3];
  std::vector<std::string> expected = {"egl_opened eglGetProcAddress dlsym",
                                       "egl_opened eglSwapBuffers getprocaddress"};
  EXPECT_EQ(run_program(preload, program).seen, expected);
  expected.insert(expected.begin() + 1, "egl_opened eglSwapBuffers glvnd");
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(run_program(both, program).seen, expected);
}

}  // namespace
}  // namespace tilepress::testing
