// OSMesa: programs that draw into memory and have no presenting call.
#include <gtest/gtest.h>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

constexpr unsigned kFrames = 4;

std::vector<std::string> command_of(const char* road, const char* format, const char* y_up, const char* end) {
  return {TILEPRESS_OSMESA, road, format, y_up, end, std::to_string(kFrames)};
}

/// Returns the known picture in R5 G6 B5: value v becomes the level v · (2^bits − 1) / 255, rounded down.
std::vector<uint8_t> in_565(const std::vector<uint8_t>& rgba) {
  std::vector<uint8_t> bytes;
  for (size_t pixel = 0; pixel < rgba.size(); pixel += 4) {
    const uint32_t word =
        (rgba[pixel] * 31u / 255) << 11 | (rgba[pixel + 1] * 63u / 255) << 5 | rgba[pixel + 2] * 31u / 255;
    bytes.push_back(static_cast<uint8_t>(word));
    bytes.push_back(static_cast<uint8_t>(word >> 8));
  }
  return bytes;
}

struct Case {
  const char* road;
  const char* format;
  const char* y_up;
  const char* end;
};

class Osmesa : public ::testing::TestWithParam<Case> {};

TEST_P(Osmesa, FramesAreTakenOfTheBufferOncePerFrame) {
  const auto& [road, format, y_up, end] = GetParam();
  const ProcessResult without = run_process(command_of(road, format, y_up, end), {{"LD_PRELOAD", ""}});
  ShimTest test;
  const ShimRun run = test.run(command_of(road, format, y_up, end));
  if (run.process.exited_with(77)) GTEST_SKIP() << "the driver has no such buffer";
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  EXPECT_EQ(run.process.out, without.out);
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  EXPECT_EQ(run.runs[0].json_text("api"), "OSMesa");
  ASSERT_EQ(run.runs[0].frames.size(), kFrames) << run.log;
  const bool is_565 = std::string(format) == "565";
  for (unsigned frame = 0; frame < kFrames; ++frame) {
    const std::vector<uint8_t> picture = expected_picture(frame, 33, 21, true);
    EXPECT_EQ(run.runs[0].frames[frame].at("format"), is_565 ? "RGB565" : "RGBA8");
    EXPECT_EQ(test.dump(0, frame), is_565 ? in_565(picture) : picture) << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Buffers, Osmesa,
    ::testing::Values(Case{"linked", "rgba", "1", "finish"}, Case{"linked", "bgra", "0", "flush"},
                      Case{"linked", "argb", "1", "both"}, Case{"linked", "565", "0", "finish"},
                      Case{"opened", "rgba", "0", "finish"}, Case{"opened", "bgra", "1", "both"}),
    [](const auto& test) {
      return std::string(test.param.road) + "_" + test.param.format + "_" + test.param.y_up + "_" +
             test.param.end;
    });

TEST(OsmesaLimits, PixelsOfThreeBytesAreCountedAsUnsupported) {
  ShimTest test;
  const ShimRun run = test.run(command_of("linked", "rgb", "1", "finish"));
  if (run.process.exited_with(77)) GTEST_SKIP() << "the driver has no such buffer";
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  EXPECT_EQ(run.runs[0].json_number("unsupported"), kFrames);
  EXPECT_TRUE(run.runs[0].frames.empty());
}

TEST(OsmesaInGlfw, FramesEndWithGlfwSwapBuffers) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_GLFW, "osmesa", "5", "67", "45"}, {{"DISPLAY", own_display()}});
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  EXPECT_EQ(run.process.out, "done\n");
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  EXPECT_EQ(run.runs[0].json_text("api"), "OSMesa");
  ASSERT_EQ(run.runs[0].frames.size(), 5u) << run.log;
  for (unsigned frame = 0; frame < 5; ++frame)
    EXPECT_EQ(test.dump(0, frame), expected_picture(frame, 67, 45, true)) << "frame " << frame;
}

}  // namespace
}  // namespace tilepress::testing
