// The colour CDF of a frame: ranks, ties, shares and how colours are written.
#include "tilepress/color_cdf.h"

#include <gtest/gtest.h>

#include "surface_samples.h"

namespace tilepress {
namespace {

SampleFrame frame_of(PixelFormat format, uint32_t width, std::vector<uint32_t> words) {
  SampleFrame frame{width, static_cast<uint32_t>(words.size()) / width, format, std::move(words), {}};
  frame.pack();
  return frame;
}

TEST(ColorCdf, RanksColoursByCountAndTiesByTheirText) {
  // As text 01000000, 00010000, 00000002: the words' own order would be the reverse.
  const uint32_t red = 0x00000001, green = 0x00000100, alpha = 0x02000000, often = 0xFFFFFFFF;
  const auto frame = frame_of(PixelFormat::kRgba8, 3, {red, often, green, alpha, often, often});
  std::string rows;
  append_color_cdf(7, 2, frame.format, color_counts(frame.view()), rows);
  // 6 pixels: 3/6, 4/6, 5/6, 6/6.
  EXPECT_EQ(rows,
            "7,2,1,#FFFFFFFF,3,0.5\n"
            "7,2,2,#00000002,1,0.6666666666666666\n"
            "7,2,3,#00010000,1,0.8333333333333334\n"
            "7,2,4,#01000000,1,1\n");
  EXPECT_EQ(color_cdf_header(), "frame,surface,rank,color,count,cumulative\n");
}

TEST(ColorCdf, CountsPixelsInsideTheSurfaceOnly) {
  const auto counts = color_counts(frame_of(PixelFormat::kRgba8, 1, {5}).view());
  ASSERT_EQ(counts.size(), 1u);
  EXPECT_EQ(counts[0].count, 1u) << "not the 64 of the padded block";
}

TEST(ColorCdf, WritesEachFormatsChannels) {
  EXPECT_EQ(color_text(0x44332211, PixelFormat::kRgba8), "#11223344");
  EXPECT_EQ(color_text(0xFF332211, PixelFormat::kRgbx8), "#112233FF");
  // R 10000 → 10000100, G 100000 → 10000010, B 00001 → 00001000
  EXPECT_EQ(color_text(0x10 << 11 | 0x20 << 5 | 1, PixelFormat::kRgb565), "#848208FF");
  EXPECT_EQ(color_text(0xFFFF, PixelFormat::kRgb565), "#FFFFFFFF");
  EXPECT_EQ(color_text(0x3FFu | 0x001u << 10 | 0x200u << 20 | 2u << 30, PixelFormat::kRgb10a2),
            "#3FF0012002");
}

TEST(ColorCdf, SumsUpToTheFrame) {
  const auto frame = mixed_frame(67, 129, PixelFormat::kRgba8, 1);
  const auto counts = color_counts(frame.view());
  uint64_t pixels = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    pixels += counts[i].count;
    if (i > 0) {
      EXPECT_LE(counts[i].count, counts[i - 1].count);
    }
  }
  EXPECT_EQ(pixels, 67u * 129);
}

TEST(ColorCoverage, IsWhatTheFirstRowsCount) {
  const auto frame = mixed_frame(67, 129, PixelFormat::kRgba8, 1);
  const auto counts = color_counts(frame.view());
  const std::vector<uint64_t> most = {1, 2, 10, counts.size(), counts.size() + 1};
  const ColorCoverage coverage = color_coverage(frame.view(), most);
  EXPECT_EQ(coverage.colors, counts.size());
  for (size_t i = 0; i < most.size(); ++i) {
    uint64_t pixels = 0;
    for (size_t rank = 0; rank < most[i] && rank < counts.size(); ++rank) pixels += counts[rank].count;
    EXPECT_EQ(coverage.pixels[i], pixels) << most[i] << " colours";
  }
}

}  // namespace
}  // namespace tilepress
