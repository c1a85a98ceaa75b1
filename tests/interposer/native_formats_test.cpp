// Native formats: surfaces of other depths keep their pixels, which are never widened.
#include <gtest/gtest.h>

#include "expected_picture.h"
#include "shim_process.h"

namespace tilepress::testing {
namespace {

constexpr int kWidth = 33, kHeight = 21;

struct Case {
  const char* name;
  std::vector<std::string> bits;
  uint32_t channel_bits[4], channel_shift[4], pixel_bytes;
  bool opaque;
};

/// Returns the known picture in the format: value v becomes the level v · (2^bits − 1) / 255, rounded down.
std::vector<uint8_t> expected_native(unsigned frame, const Case& format) {
  const std::vector<uint8_t> rgba = expected_picture(frame, kWidth, kHeight, !format.opaque);
  std::vector<uint8_t> bytes;
  for (size_t pixel = 0; pixel < rgba.size(); pixel += 4) {
    uint32_t word = 0;
    for (size_t c = 0; c < 4; ++c) {
      const uint32_t largest = (1u << format.channel_bits[c]) - 1u;
      word |= rgba[pixel + c] * largest / 255 << format.channel_shift[c];
    }
    for (uint32_t b = 0; b < format.pixel_bytes; ++b) bytes.push_back(static_cast<uint8_t>(word >> (8 * b)));
  }
  return bytes;
}

class NativeFormat : public ::testing::TestWithParam<Case> {};

TEST_P(NativeFormat, IsReadWithoutConversion) {
  ShimTest test;
  std::vector<std::string> command = {TILEPRESS_EGL_SCENES, "format"};
  command.insert(command.end(), GetParam().bits.begin(), GetParam().bits.end());
  const ShimRun run = test.run(command);
  if (run.process.exited_with(77)) GTEST_SKIP() << "the driver has no such config";
  EXPECT_TRUE(run.process.exited_with(0));
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  ASSERT_EQ(run.runs[0].frames.size(), 5u) << run.log;
  for (unsigned frame = 0; frame < 5; ++frame) {
    EXPECT_EQ(run.runs[0].frames[frame].at("format"), GetParam().name);
    EXPECT_EQ(test.dump(0, frame), expected_native(frame, GetParam())) << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(
    NativeFormats, NativeFormat,
    ::testing::Values(
        Case{"RGBA8", {"8", "8", "8", "8", "0"}, {8, 8, 8, 8}, {0, 8, 16, 24}, 4, false},
        Case{"RGBX8", {"8", "8", "8", "0", "0"}, {8, 8, 8, 8}, {0, 8, 16, 24}, 4, true},
        Case{"RGB565", {"5", "6", "5", "0", "0"}, {5, 6, 5, 0}, {11, 5, 0, 0}, 2, true},
        Case{"RGB10A2", {"10", "10", "10", "2", "0"}, {10, 10, 10, 2}, {0, 10, 20, 30}, 4, false}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(NativeFormats, AFormatThatIsNotModelledIsCountedAndReportedOnce) {
  ShimTest test;
  const ShimRun run = test.run({TILEPRESS_EGL_SCENES, "format", "16", "16", "16", "16", "1"});
  if (run.process.exited_with(77)) GTEST_SKIP() << "the driver has no such config";
  EXPECT_TRUE(run.process.exited_with(0));
  ASSERT_EQ(run.runs.size(), 1u) << run.log;
  EXPECT_EQ(run.runs[0].frames.size(), 0u);
  EXPECT_EQ(run.runs[0].json_number("unsupported"), 5);
  EXPECT_EQ(run.log, "tilepress: surface 0: unsupported format RGBA16F\n");
}

}  // namespace
}  // namespace tilepress::testing
