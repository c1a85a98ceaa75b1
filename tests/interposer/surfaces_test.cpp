// Surfaces: several windows, threads and sizes. Each is a surface with its own frames, and all pixels are
// right.
#include <gtest/gtest.h>

#include <set>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

ShimRun run_scene(ShimTest& test, std::vector<std::string> arguments,
                  std::map<std::string, std::string> environment = {}) {
  arguments.insert(arguments.begin(), TILEPRESS_EGL_SCENES);
  return test.run(arguments, std::move(environment));
}

/// Expects exactly the frames 0 … frames-1 of `surface` at this size, each with the known picture.
void expect_surface(const ShimTest& test, const CapturedRun& run, uint32_t surface, unsigned frames,
                    int width, int height, bool with_alpha = true) {
  std::vector<std::string> found;
  for (const auto& row : run.frames) {
    if (row.at("surface") != std::to_string(surface)) continue;
    found.push_back(row.at("frame"));
    EXPECT_EQ(row.at("width"), std::to_string(width));
    EXPECT_EQ(row.at("height"), std::to_string(height));
  }
  ASSERT_EQ(found.size(), frames) << "surface " << surface;
  for (unsigned frame = 0; frame < frames; ++frame) {
    EXPECT_EQ(found[frame], std::to_string(frame));
    EXPECT_EQ(test.dump(surface, frame), expected_picture(frame, width, height, with_alpha))
        << "surface " << surface << " frame " << frame;
  }
}

TEST(Surfaces, FourThreadsPresentingAtOnceAreFourSurfaces) {
  ShimTest test;
  const ShimRun run = run_scene(test, {"threads"});
  EXPECT_TRUE(run.process.exited_with(0));
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].frames.size(), 48u) << run.log;
  std::map<std::string, uint32_t> surface_by_width;
  for (const auto& row : run.runs[0].frames)
    surface_by_width[row.at("width")] = static_cast<uint32_t>(std::stoul(row.at("surface")));
  ASSERT_EQ(surface_by_width.size(), 4u);
  for (const auto& [width, surface] : surface_by_width)
    expect_surface(test, run.runs[0], surface, 12, std::stoi(width), std::stoi(width) + 1);
}

TEST(Surfaces, TwoSurfacesOfOneContextHaveFramesOfTheirOwn) {
  ShimTest test;
  const ShimRun run = run_scene(test, {"alternate"});
  ASSERT_EQ(run.runs.size(), 1u);
  expect_surface(test, run.runs[0], 0, 5, 32, 32);
  expect_surface(test, run.runs[0], 1, 5, 48, 24);
}

TEST(Surfaces, ASurfaceMadeAgainIsANewSurface) {
  for (const char* scene : {"recreate", "terminate"}) {
    ShimTest test;
    const ShimRun run = run_scene(test, {scene});
    EXPECT_TRUE(run.process.exited_with(0)) << scene;
    ASSERT_EQ(run.runs.size(), 1u);
    EXPECT_EQ(run.runs[0].frames.size(), 12u) << scene << run.log;
    if (std::string(scene) == "terminate") continue;  // the driver chooses the handles
    for (uint32_t surface = 0; surface < 3; ++surface) expect_surface(test, run.runs[0], surface, 4, 32, 32);
  }
}

TEST(Surfaces, AResizedWindowGoesOnAsANewSurface) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_GLX_RESIZE}, {{"DISPLAY", own_display()}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  EXPECT_EQ(run.process.out, "X errors: 0\n");
  ASSERT_EQ(run.runs.size(), 1u);
  expect_surface(test, run.runs[0], 0, 3, 64, 48, false);
  expect_surface(test, run.runs[0], 1, 3, 80, 40, false);
  expect_surface(test, run.runs[0], 2, 3, 33, 77, false);
  expect_surface(test, run.runs[0], 3, 3, 64, 48, false);
}

TEST(Surfaces, DamageRectanglesAreRecordedAndRefusedPresentsAreNoFrames) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_EGL_DAMAGE}, {{"DISPLAY", own_display()}});
  const ProcessResult without =
      run_process({TILEPRESS_EGL_DAMAGE}, {{"LD_PRELOAD", ""}, {"DISPLAY", own_display()}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  EXPECT_EQ(run.process.out, without.out);
  EXPECT_NE(run.process.out.find("swap 1"), std::string::npos) << run.process.out;
  ASSERT_EQ(run.runs.size(), 1u);
  expect_surface(test, run.runs[0], 0, 3, 64, 48, false);
  ASSERT_EQ(run.runs[0].presents.size(), 3u);
  EXPECT_EQ(run.runs[0].presents[0].at("damage"), "");  // everything
  EXPECT_EQ(run.runs[0].presents[1].at("damage"), "1 2 3 4");
  EXPECT_EQ(run.runs[0].presents[2].at("damage"), "1 2 3 4;50 6 7 8");
}

/// Runs glx_presents with and without the shim. Expects the same output, and three known frames.
ShimRun run_glx_presents(ShimTest& test, const char* mode,
                         std::map<std::string, std::string> environment = {}) {
  environment["DISPLAY"] = own_display();
  const ShimRun run = test.run({TILEPRESS_GLX_PRESENTS, mode}, environment);
  environment["LD_PRELOAD"] = "";
  const ProcessResult without = run_process({TILEPRESS_GLX_PRESENTS, mode}, environment);
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  EXPECT_EQ(run.process.out, without.out);
  EXPECT_EQ(run.process.err, without.err);
  EXPECT_EQ(run.runs.size(), 1u) << run.log;
  if (run.runs.size() == 1) expect_surface(test, run.runs[0], 0, 3, 64, 48, false);
  return run;
}

class GlxPresents : public ::testing::TestWithParam<Road> {};

TEST_P(GlxPresents, CopySubBufferIsAPresentWithItsRectangle) {
  ShimTest test(GetParam());
  const ShimRun run = run_glx_presents(test, "copy");
  ASSERT_EQ(run.runs.size(), 1u);
  ASSERT_EQ(run.runs[0].presents.size(), 3u);
  EXPECT_EQ(run.runs[0].presents[0].at("damage"), "0 4 16 12");
  EXPECT_EQ(run.runs[0].presents[2].at("damage"), "16 4 16 12");
}

TEST_P(GlxPresents, SwapBuffersMscIsAPresentUnlessItIsRefused) {
  ShimTest test(GetParam());
  const ShimRun run = run_glx_presents(test, "msc");
  EXPECT_EQ(run.process.out.rfind("swap refused, done\n", 0), 0u) << run.process.out;
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].json_number("seen"), 3);
}

// The context ends when another becomes current. So its frames are read in the context itself.
TEST_P(GlxPresents, AContextDestroyedWhileCurrentLivesOn) {
  ShimTest test(GetParam());
  run_glx_presents(test, "destroyed");
}

// A driver may query contexts from the X server, where a destroyed one is an error.
TEST(Surfaces, AContextDestroyedWhileCurrentIsNotAskedAbout) {
  ShimTest test;
  run_glx_presents(
      test, "destroyed",
      {{"__GLX_VENDOR_LIBRARY_NAME", "strict"}, {"LD_LIBRARY_PATH", TILEPRESS_STRICT_VENDOR_FOLDER}});
}

TEST_P(GlxPresents, ASingleBufferedWindowIsReadToo) {
  ShimTest test(GetParam());
  run_glx_presents(test, "single");
}

INSTANTIATE_TEST_SUITE_P(Surfaces, GlxPresents, ::testing::Values(Road::kPreload, Road::kGlvnd, Road::kBoth),
                         [](const auto& road) {
                           return road.param == Road::kPreload ? "Preload"
                                  : road.param == Road::kGlvnd ? "Glvnd"
                                                               : "Both";
                         });

/// Returns the three frames of `bytes` bytes that the program has read and printed itself.
void expect_printed_frames(const ShimTest& test, const ShimRun& run, size_t bytes) {
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  EXPECT_EQ(run.runs[0].frames.size(), 3u) << run.log;
  ASSERT_GE(run.process.out.size(), 3 * bytes);
  for (unsigned frame = 0; frame < 3; ++frame) {
    const auto begin = run.process.out.begin() + static_cast<std::ptrdiff_t>(frame * bytes);
    const std::vector<uint8_t> own(begin, begin + static_cast<std::ptrdiff_t>(bytes));
    EXPECT_EQ(test.dump(0, frame), own) << "frame " << frame;
  }
}

/// Returns the reds of the first printed frame. The triangle has 230 (0.9), or 243 if encoded. Pixels with
/// one, two or three of four samples covered have 58, 115 and 173.
std::set<uint8_t> printed_reds(const ShimRun& run, size_t bytes) {
  std::set<uint8_t> reds;
  for (size_t pixel = 0; pixel < bytes && pixel < run.process.out.size(); pixel += 4)
    reds.insert(static_cast<uint8_t>(run.process.out[pixel]));
  return reds;
}

class PrintedFrames : public ::testing::TestWithParam<Road> {
 protected:
  ShimRun run(const std::vector<std::string>& command) {
    const ShimRun run = test_.run(command, {{"DISPLAY", own_display()}});
    const ProcessResult without = run_process(command, {{"LD_PRELOAD", ""}, {"DISPLAY", own_display()}});
    EXPECT_EQ(run.process.status, without.status);
    EXPECT_EQ(run.process.out, without.out);
    EXPECT_EQ(run.process.err, without.err);
    return run;
  }
  ShimTest test_{GetParam()};
};

TEST_P(PrintedFrames, MultisampledSurfacesAreCapturedAsWhatIsShown) {
  const ShimRun run_egl = run({TILEPRESS_EGL_SCENES, "samples"});
  if (run_egl.process.exited_with(77)) GTEST_SKIP() << "the driver has no such config";
  expect_printed_frames(test_, run_egl, 40 * 24 * 4);
  EXPECT_EQ(printed_reds(run_egl, 40 * 24 * 4), (std::set<uint8_t>{0, 58, 115, 173, 230}));
}

TEST_P(PrintedFrames, MultisampledWindowsAreCapturedAsWhatIsShown) {
  const ShimRun run_glx = run({TILEPRESS_GLX_PRESENTS, "samples"});
  if (run_glx.process.exited_with(77)) GTEST_SKIP() << "the driver has no such visual";
  expect_printed_frames(test_, run_glx, 64 * 48 * 4);
  EXPECT_EQ(printed_reds(run_glx, 64 * 48 * 4), (std::set<uint8_t>{0, 58, 115, 173, 230}));
}

TEST_P(PrintedFrames, EncodedSurfacesAreReadAsTheyAreAndNamed) {
  const ShimRun run_egl = run({TILEPRESS_EGL_SCENES, "srgb"});
  if (run_egl.process.exited_with(77)) GTEST_SKIP() << "the driver has no such surface";
  expect_printed_frames(test_, run_egl, 40 * 24 * 4);
  EXPECT_EQ(printed_reds(run_egl, 40 * 24 * 4).count(243), 1u) << "not encoded: the test proves nothing";
  ASSERT_EQ(run_egl.runs.at(0).surfaces.size(), 1u);
  EXPECT_EQ(run_egl.runs[0].surfaces[0].at("color_space"), "srgb");
}

TEST_P(PrintedFrames, EncodedWindowsAreReadAsTheyAreAndNamed) {
  const ShimRun run_glx = run({TILEPRESS_GLX_PRESENTS, "srgb"});
  if (run_glx.process.exited_with(77)) GTEST_SKIP() << "the driver has no such visual";
  expect_printed_frames(test_, run_glx, 64 * 48 * 4);
  EXPECT_EQ(printed_reds(run_glx, 64 * 48 * 4).count(243), 1u) << "not encoded: the test proves nothing";
  ASSERT_EQ(run_glx.runs.at(0).surfaces.size(), 1u);
  EXPECT_EQ(run_glx.runs[0].surfaces[0].at("color_space"), "srgb");
}

INSTANTIATE_TEST_SUITE_P(Surfaces, PrintedFrames,
                         ::testing::Values(Road::kPreload, Road::kGlvnd, Road::kBoth), [](const auto& road) {
                           return road.param == Road::kPreload ? "Preload"
                                  : road.param == Road::kGlvnd ? "Glvnd"
                                                               : "Both";
                         });

/// Windows that are presented while they are not current on the calling thread.
class IdleDrawables : public ::testing::TestWithParam<Road> {
 protected:
  ShimRun run(const char* mode) {
    const ShimRun run = test_.run({TILEPRESS_GLX_IDLE, mode}, {{"DISPLAY", own_display()}});
    const ProcessResult without =
        run_process({TILEPRESS_GLX_IDLE, mode}, {{"LD_PRELOAD", ""}, {"DISPLAY", own_display()}});
    EXPECT_TRUE(run.process.exited_with(0)) << mode << run.process.err;
    EXPECT_EQ(run.process.out, without.out) << mode;
    EXPECT_EQ(run.process.err, without.err) << mode;
    EXPECT_EQ(run.runs.size(), 1u) << mode << run.log;
    return run;
  }
  ShimTest test_{GetParam()};
};

TEST_P(IdleDrawables, AreCapturedWhileAnotherIsCurrent) {
  const ShimRun captured = run("other");
  ASSERT_EQ(captured.runs.size(), 1u);
  expect_surface(test_, captured.runs[0], 0, 3, 64, 48, false);
  expect_surface(test_, captured.runs[0], 1, 3, 48, 40, false);
  EXPECT_EQ(captured.runs[0].json_text("api"), "GLX");
}

TEST_P(IdleDrawables, AreTheSameSurfacesWhenTheyAreCurrent) {
  const ShimRun captured = run("sometimes");
  ASSERT_EQ(captured.runs.size(), 1u);
  EXPECT_EQ(captured.runs[0].surfaces.size(), 2u);
  expect_surface(test_, captured.runs[0], 0, 3, 64, 48, false);
  expect_surface(test_, captured.runs[0], 1, 3, 48, 40, false);
}

TEST_P(IdleDrawables, AreCapturedWhileNothingIsCurrent) {
  const ShimRun captured = run("released");
  ASSERT_EQ(captured.runs.size(), 1u);
  expect_surface(test_, captured.runs[0], 0, 3, 64, 48, false);
  expect_surface(test_, captured.runs[0], 1, 3, 48, 40, false);
}

TEST_P(IdleDrawables, AreCapturedFromAnotherThreadUnlessTheyAreCurrentOnOne) {
  const ShimRun captured = run("after");
  ASSERT_EQ(captured.runs.size(), 1u);
  expect_surface(test_, captured.runs[0], 0, 3, 64, 48, false);
  expect_surface(test_, captured.runs[0], 1, 3, 48, 40, false);
}

TEST_P(IdleDrawables, OfAnotherThreadAreCountedAsNotCaptured) {
  const ShimRun captured = run("thread");
  ASSERT_EQ(captured.runs.size(), 1u);
  expect_surface(test_, captured.runs[0], 0, 3, 64, 48, false);
  EXPECT_EQ(captured.runs[0].frames.size(), 3u);
  EXPECT_EQ(captured.runs[0].json_number("seen"), 6);
  EXPECT_EQ(captured.runs[0].json_number("not_captured"), 3);
  EXPECT_EQ(captured.log, "tilepress: not captured: another thread has the drawable current\n");
}

// Mesa sends such a present to the X server, which refuses it. The program sees that error and no other.
TEST_P(IdleDrawables, OfPlainWindowsHaveNoBuffers) {
  const ShimRun captured = run("plain");
  ASSERT_EQ(captured.runs.size(), 1u);
  expect_surface(test_, captured.runs[0], 0, 3, 48, 40, false);
  EXPECT_EQ(captured.runs[0].frames.size(), 3u);
  EXPECT_EQ(captured.runs[0].json_number("not_captured"), 3);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, IdleDrawables,
                         ::testing::Values(Road::kPreload, Road::kGlvnd, Road::kBoth), [](const auto& road) {
                           return road.param == Road::kPreload ? "Preload"
                                  : road.param == Road::kGlvnd ? "Glvnd"
                                                               : "Both";
                         });

TEST(Surfaces, LargeFramesAreNoMatterOfTheProgramsAllocator) {
  ShimTest test;
  const ShimRun run = run_scene(test, {"large"});
  EXPECT_TRUE(run.process.exited_with(0));
  ASSERT_EQ(run.runs.size(), 1u);
  expect_surface(test, run.runs[0], 0, 3, 600, 600);
  expect_surface(test, run.runs[0], 1, 3, 1100, 1100);
  expect_surface(test, run.runs[0], 2, 3, 512, 512);
}

TEST(Surfaces, AContextDestroyedWhileCurrentBehavesAsWithoutTheShim) {
  ShimTest test;
  const ShimRun run = run_scene(test, {"destroyed"});
  const ProcessResult without = run_process({TILEPRESS_EGL_SCENES, "destroyed"}, {{"LD_PRELOAD", ""}});
  EXPECT_EQ(run.process.status, without.status);
  EXPECT_EQ(run.process.out, without.out);
}

TEST(Surfaces, FailedSwapsFailAsWithoutTheShimAndAreNoFrames) {
  ShimTest test;
  const ShimRun run = run_scene(test, {"failures"});
  const ProcessResult without = run_process({TILEPRESS_EGL_SCENES, "failures"}, {{"LD_PRELOAD", ""}});
  EXPECT_EQ(run.process.out, without.out);
  ASSERT_EQ(run.runs.size(), 1u);
  EXPECT_EQ(run.runs[0].frames.size(), 1u);
  EXPECT_EQ(run.runs[0].json_number("seen"), 1);
}

TEST(Surfaces, WithoutAPrivateContextFramesAreReadInTheProgramsOwn) {
  ShimTest test;
  const ShimRun run = run_scene(test, {"alternate"}, {{"TILEPRESS_READBACK", "in-context"}});
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  expect_surface(test, run.runs[0], 0, 5, 32, 32);
  expect_surface(test, run.runs[0], 1, 5, 48, 24);
}

}  // namespace
}  // namespace tilepress::testing
