// Targets: with --targets all, each image of the program's framebuffers is a surface of its own, captured
// when the program turns away from it.
#include <gtest/gtest.h>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

constexpr uint32_t kFirst = 1000000;
constexpr unsigned kFrames = 4;

std::map<std::string, std::string> all_targets(Road road) {
  std::map<std::string, std::string> environment = {{"TILEPRESS_TARGETS", "all"}};
  if (road != Road::kGlvnd) environment["LD_PRELOAD"] = TILEPRESS_PRELOAD_GL;
  return environment;
}

ShimRun run_scene(ShimTest& test, const char* api, const char* scene, Road road) {
  const ShimRun run = test.run({TILEPRESS_FRAMEBUFFER_SCENES, api, scene}, all_targets(road));
  EXPECT_TRUE(run.process.exited_with(0)) << scene;
  const ProcessResult without = run_process({TILEPRESS_FRAMEBUFFER_SCENES, api, scene}, {{"LD_PRELOAD", ""}});
  EXPECT_EQ(run.process.out, without.out) << scene;
  EXPECT_EQ(run.process.err, without.err) << scene;
  return run;
}

/// The surface has exactly these frames of the known picture, in this order.
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
  EXPECT_EQ(captured.runs[0].json_number("measured_frames"), kFrames - 1);  // of what is presented
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
                                           Case{"gl", Road::kGlvnd}, Case{"es3", Road::kBoth}),
                         [](const auto& test) {
                           const char* road = test.param.road == Road::kPreload ? "Preload"
                                              : test.param.road == Road::kGlvnd ? "Glvnd"
                                                                                : "Both";
                           return std::string(test.param.api) + "_" + road;
                         });

TEST(TargetFormats, MultisampledAndFloatImagesAreCountedAsUnsupported) {
  ShimTest multisampled, floats;
  const ShimRun first = run_scene(multisampled, "es3", "renderbuffers", Road::kPreload);
  expect_surface(multisampled, first, kFirst, {0, 1, 2, 3}, 40, 24);
  EXPECT_EQ(first.log, "tilepress: surface 1000001: renderbuffer 2, multisampled: unsupported format\n");
  const ShimRun second = run_scene(floats, "es3", "formats", Road::kPreload);
  EXPECT_EQ(second.log, "tilepress: surface 1000000: texture 2: unsupported format RGBA16F\n");
  // The last "unsupported" of run.json is the targets'.
  const std::string& json = second.runs.at(0).json;
  EXPECT_NE(json.find("\"unsupported\": 4", json.find("\"targets\": {")), std::string::npos) << json;
}

TEST(TargetFormats, EncodedValuesAreReadAsTheyAreAndNamed) {
  ShimTest test;
  const ShimRun run = run_scene(test, "es3", "formats", Road::kPreload);
  ASSERT_EQ(run.runs.size(), 1u);
  const std::vector<uint8_t> own(run.process.out.begin(), run.process.out.end());  // as the program reads it
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
