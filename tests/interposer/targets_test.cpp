// Targets: with --targets all, each image of the program's framebuffers is a surface, captured when the
// program turns away from it.
#include <gtest/gtest.h>

#include <set>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

constexpr uint32_t kFirst = 1000000;
constexpr unsigned kFrames = 4;

std::map<std::string, std::string> all_targets(Road road) {
  std::map<std::string, std::string> environment = {{"TILEPRESS_TARGETS", "all"}, {"DISPLAY", own_display()}};
  if (road != Road::kGlvnd) environment["LD_PRELOAD"] = TILEPRESS_PRELOAD_GL;
  return environment;
}

ShimRun run_scene(ShimTest& test, const char* api, const char* scene, Road road) {
  const ShimRun run = test.run({TILEPRESS_FRAMEBUFFER_SCENES, api, scene}, all_targets(road));
  EXPECT_TRUE(run.process.exited_with(0)) << scene;
  const ProcessResult without = run_process({TILEPRESS_FRAMEBUFFER_SCENES, api, scene},
                                            {{"LD_PRELOAD", ""}, {"DISPLAY", own_display()}});
  EXPECT_EQ(run.process.out, without.out) << scene;
  EXPECT_EQ(run.process.err, without.err) << scene;
  return run;
}

/// Expects exactly these frames of the known picture, in this order.
void expect_surface(const ShimTest& test, const ShimRun& run, uint32_t surface,
                    std::vector<unsigned> pictures, int width, int height) {
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  size_t rows = 0;
  for (const auto& row : run.runs[0].frames) {
    if (row.at("surface") != std::to_string(surface)) continue;
    EXPECT_EQ(row.at("frame"), std::to_string(rows++));
    EXPECT_EQ(row.at("width"), std::to_string(width));
  }
  EXPECT_EQ(rows, pictures.size()) << "surface " << surface << "\n" << run.log;
  for (size_t frame = 0; frame < pictures.size(); ++frame)
    EXPECT_EQ(test.dump(surface, frame), expected_picture(pictures[frame], width, height, true))
        << "surface " << surface << " frame " << frame;
}

struct Case {
  const char* api;
  Road road;
};

std::string name_of_case(const ::testing::TestParamInfo<Case>& test) {
  const char* road = test.param.road == Road::kPreload ? "Preload"
                     : test.param.road == Road::kGlvnd ? "Glvnd"
                                                       : "Both";
  return std::string(test.param.api) + "_" + road;
}

class Targets : public ::testing::TestWithParam<Case> {
 protected:
  ShimRun run(const char* scene) { return run_scene(test_, GetParam().api, scene, GetParam().road); }
  void expect(const ShimRun& run, uint32_t surface, std::vector<unsigned> pictures, int width, int height) {
    expect_surface(test_, run, surface, std::move(pictures), width, height);
  }
  ShimTest test_{GetParam().road};
};

TEST_P(Targets, OneTextureIsOneSurfaceBesideTheWindow) {
  const ShimRun captured = run("single");
  expect(captured, kFirst, {0, 1, 2, 3}, 40, 24);
  expect(captured, 0, {0, 1, 2, 3}, 33, 21);
  ASSERT_EQ(captured.runs.size(), 1u);
  EXPECT_EQ(captured.runs[0].json_number("seen"), kFrames);
  EXPECT_EQ(captured.runs[0].json_number("measured_frames"), kFrames - 1);  // presented frames
}

TEST_P(Targets, EachColourAttachmentIsASurfaceLeftWhenItIsNoDrawBufferAnyMore) {
  const ShimRun captured = run("mrt");
  expect(captured, kFirst, {0, 1, 2, 3}, 40, 24);
  expect(captured, kFirst + 1, {100, 101, 102, 103}, 40, 24);
  expect(captured, 0, {0, 1, 2, 3}, 33, 21);
}

TEST_P(Targets, FramebuffersByTurnsAreSurfacesByTurns) {
  const ShimRun captured = run("pingpong");
  expect(captured, kFirst, {0, 1}, 24, 24);
  expect(captured, kFirst + 1, {0, 1}, 24, 24);
}

TEST_P(Targets, ATextureMadeAgainIsANewSurface) {
  const ShimRun captured = run("recreate");
  for (uint32_t round = 0; round < 3; ++round) expect(captured, kFirst + round, {0, 1, 2, 3}, 24, 16);
}

TEST_P(Targets, ATextureRespecifiedAtAnotherSizeIsANewSurface) {
  const ShimRun captured = run("resize");
  expect(captured, kFirst, {0, 1}, 24, 16);
  expect(captured, kFirst + 1, {0, 1}, 32, 16);
}

TEST_P(Targets, PartsOfTexturesAreSurfacesOfTheirOwn) {
  const ShimRun captured = run("parts");
  expect(captured, kFirst, {0, 1, 2, 3}, 24, 24);
  expect(captured, kFirst + 1, {0, 1, 2, 3}, 32, 24);
  expect(captured, kFirst + 2, {0, 1, 2, 3}, 40, 24);
}

TEST_P(Targets, ContextsHaveImagesOfTheirOwn) {
  const ShimRun captured = run("contexts");
  expect(captured, kFirst, {0, 1, 2, 3}, 24, 24);
  expect(captured, kFirst + 1, {0, 1, 2, 3}, 32, 24);
}

TEST_P(Targets, WhatIsInvalidatedIsNotCaptured) {
  const ShimRun captured = run("invalidate");
  ASSERT_EQ(captured.runs.size(), 1u);
  EXPECT_EQ(captured.runs[0].frames.size(), kFrames);
  expect(captured, 0, {0, 1, 2, 3}, 33, 21);
}

INSTANTIATE_TEST_SUITE_P(Apis, Targets,
                         ::testing::Values(Case{"es2", Road::kPreload}, Case{"es3", Road::kPreload},
                                           Case{"gl", Road::kPreload}, Case{"es3", Road::kGlvnd},
                                           Case{"gl", Road::kGlvnd}, Case{"es3", Road::kBoth},
                                           Case{"glx", Road::kPreload}, Case{"glx", Road::kGlvnd},
                                           Case{"glx", Road::kBoth}),
                         name_of_case);

TEST(TargetFormats, FloatImagesAreCountedAsUnsupported) {
  ShimTest test;
  const ShimRun run = run_scene(test, "es3", "formats", Road::kPreload);
  EXPECT_EQ(run.log, "tilepress: surface 1000000: texture 2: unsupported format RGBA16F\n");
  // The last "unsupported" of run.json belongs to the targets.
  const std::string& json = run.runs.at(0).json;
  EXPECT_NE(json.find("\"unsupported\": 4", json.find("\"targets\": {")), std::string::npos) << json;
}

class MultisampledTargets : public ::testing::TestWithParam<Case> {};

TEST_P(MultisampledTargets, AreWhatTheProgramItselfResolvesThemTo) {
  ShimTest test(GetParam().road);
  const ShimRun run = run_scene(test, GetParam().api, "multisampled", GetParam().road);
  ASSERT_EQ(run.runs.size(), 1u);
  constexpr size_t kBytes = 40 * 24 * 4;
  ASSERT_EQ(run.process.out.size(), kFrames * 4 * kBytes);
  std::map<std::string, uint32_t> surface_of;
  for (const auto& row : run.runs[0].surfaces)
    surface_of[row.at("origin")] = static_cast<uint32_t>(std::stoul(row.at("surface")));
  size_t at = 0;
  for (unsigned frame = 0; frame < kFrames; ++frame)
    for (const char* origin : {"renderbuffer 1 resolved", "texture 1 resolved", "texture 2 resolved",
                               "texture 3 layer 1 resolved"}) {
      const auto own = run.process.out.begin() + static_cast<std::ptrdiff_t>(kBytes * at++);
      if (surface_of.count(origin) == 0) {
        // Mesa 22 has no query for the layer: its frames count as not captured.
        EXPECT_STREQ(origin, "texture 3 layer 1 resolved");
        EXPECT_NE(run.log.find("texture 3 resolved: the driver does not say which layer"), std::string::npos)
            << run.log;
        continue;
      }
      const std::vector<uint8_t> expected(own, own + static_cast<std::ptrdiff_t>(kBytes));
      EXPECT_EQ(test.dump(surface_of[origin], frame), expected) << origin << " frame " << frame;
      std::set<uint8_t> reds;
      for (size_t pixel = 0; pixel < kBytes; pixel += 4) reds.insert(expected[pixel]);
      EXPECT_GE(reds.size(), 4u) << "no pixel covered in part: the test proves nothing";
    }
}

INSTANTIATE_TEST_SUITE_P(Apis, MultisampledTargets,
                         ::testing::Values(Case{"es3", Road::kPreload}, Case{"gl", Road::kPreload},
                                           Case{"es3", Road::kGlvnd}, Case{"gl", Road::kGlvnd},
                                           Case{"es3", Road::kBoth}, Case{"gl", Road::kBoth},
                                           Case{"glx", Road::kPreload}, Case{"glx", Road::kGlvnd}),
                         name_of_case);

TEST(TargetFormats, AMultisampledRenderbufferIsASurfaceBesideASingleSampledOne) {
  ShimTest test, in_context;
  const ShimRun run = run_scene(test, "es3", "renderbuffers", Road::kPreload);
  expect_surface(test, run, kFirst, {0, 1, 2, 3}, 40, 24);
  expect_surface(test, run, kFirst + 1, {0, 1, 2, 3}, 32, 24);
  std::map<std::string, std::string> environment = all_targets(Road::kPreload);
  environment["TILEPRESS_READBACK"] = "in-context";
  const ShimRun without = in_context.run({TILEPRESS_FRAMEBUFFER_SCENES, "gl", "renderbuffers"}, environment);
  expect_surface(in_context, without, kFirst, {0, 1, 2, 3}, 40, 24);
  EXPECT_EQ(without.log,
            "tilepress: surface 1000001: not captured: renderbuffer 2 resolved: --readback in-context forbids "
            "private contexts\n");
}

TEST(TargetFormats, EncodedValuesAreReadAsTheyAreAndNamed) {
  ShimTest test;
  const ShimRun run = run_scene(test, "es3", "formats", Road::kPreload);
  ASSERT_EQ(run.runs.size(), 1u);
  const std::vector<uint8_t> own(run.process.out.begin(),
                                 run.process.out.end());  // as the program reads them
  EXPECT_EQ(test.dump(kFirst + 1, 0), own);
  EXPECT_NE(own, expected_picture(0, 40, 24, true)) << "not encoded: the test proves nothing";
  std::map<std::string, std::string> spaces;
  for (const auto& row : run.runs[0].surfaces) spaces[row.at("origin")] = row.at("color_space");
  EXPECT_EQ(spaces["texture 1"], "srgb");
  EXPECT_EQ(spaces["window"], "linear");
}

TEST(TargetsOff, RowsOfWhatIsPresentedAreTheSameWithAndWithout) {
  ShimTest with, without;
  const ShimRun all = with.run({TILEPRESS_FRAMEBUFFER_SCENES, "es3", "mrt"}, all_targets(Road::kPreload));
  const ShimRun presented = without.run({TILEPRESS_FRAMEBUFFER_SCENES, "es3", "mrt"});
  ASSERT_EQ(all.runs.size(), 1u);
  ASSERT_EQ(presented.runs.size(), 1u);
  std::vector<std::map<std::string, std::string>> rows;
  for (const auto& row : all.runs[0].schemes)
    if (row.at("surface") == "0") rows.push_back(row);
  EXPECT_EQ(rows, presented.runs[0].schemes);
  EXPECT_EQ(presented.runs[0].json.find("\"targets\": {"), std::string::npos);
}

}  // namespace
}  // namespace tilepress::testing
