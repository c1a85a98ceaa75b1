// Frame metrics: colour counts against plain maps, over frames of few and of many colours by turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "surface_patterns.h"
#include "tilepress/plane.h"
#include "tilepress/simd.h"
#include "tilepress/surface_engine.h"

using namespace tilepress;
using reference::Picture;

namespace {

// 3346 colours are a twelfth of the pixels: the way of counting changes.
constexpr uint32_t kWidth = 251, kHeight = 160;

Picture colors_at_random(uint32_t colors, uint64_t seed, uint32_t lowest = 0) {
  patterns::Dice dice(seed);
  Picture picture{kWidth, kHeight, {}};
  while (picture.words.size() < size_t{kWidth} * kHeight)
    picture.words.push_back((lowest + dice.below(colors)) * 0x9E3779B1u);
  return picture;
}

/// Noise on the left; on the right one colour, more often than small counts go.
Picture half_noise(uint64_t seed) {
  Picture picture = patterns::draw(patterns::kNoise, kWidth, kHeight, PixelFormat::kRgba8, seed);
  for (size_t i = 0; i < picture.words.size(); ++i)
    if (i % kWidth > kWidth / 2) picture.words[i] = 0xFF00FF00;
  return picture;
}

/// Many colours, of which pixels side by side are often alike.
Picture runs_of_noise(uint32_t longest_run, uint64_t seed) {
  patterns::Dice dice(seed);
  Picture picture{kWidth, kHeight, {}};
  while (picture.words.size() < size_t{kWidth} * kHeight)
    picture.words.insert(picture.words.end(), 1 + dice.below(longest_run), dice.below(9000) * 0x9E3779B1u);
  picture.words.resize(size_t{kWidth} * kHeight);
  return picture;
}

std::map<uint32_t, int64_t> counts_of(const Picture& picture) {
  std::map<uint32_t, int64_t> counts;
  for (const uint32_t word : picture.words) ++counts[word];
  return counts;
}

void expect_metrics(const FrameMetrics& metrics, const Picture& picture,
                    const std::optional<Picture>& before) {
  const double pixels = double{kWidth} * kHeight;
  const auto counts = counts_of(picture);
  double entropy = 0;
  std::vector<int64_t> sorted;
  for (const auto& [color, count] : counts) {
    entropy -= static_cast<double>(count) / pixels * std::log2(static_cast<double>(count) / pixels);
    sorted.push_back(count);
  }
  std::sort(sorted.rbegin(), sorted.rend());
  int64_t top = 0;
  for (size_t i = 0; i < sorted.size() && i < 100; ++i) top += sorted[i];
  EXPECT_EQ(metrics.unique_colors, counts.size());
  EXPECT_NEAR(metrics.entropy, entropy, 1e-9);
  EXPECT_DOUBLE_EQ(metrics.top100_coverage, static_cast<double>(top) / pixels);
  if (!before) return;
  auto differences = counts;
  for (const auto& [color, count] : counts_of(*before)) differences[color] -= count;
  int64_t gained = 0, changed = 0;
  for (const auto& [color, difference] : differences) gained += std::max<int64_t>(0, difference);
  for (size_t i = 0; i < picture.words.size(); ++i) changed += picture.words[i] != before->words[i];
  EXPECT_DOUBLE_EQ(metrics.color_change, static_cast<double>(gained) / pixels);
  EXPECT_DOUBLE_EQ(metrics.pixel_change, static_cast<double>(changed) / pixels);
}

}  // namespace

TEST(Metrics, AreThoseOfPlainCountsHoweverManyColoursCome) {
  const std::vector<Picture> pictures = {
      colors_at_random(3, 1),
      colors_at_random(50, 2),
      colors_at_random(600, 3),
      colors_at_random(700, 4),
      colors_at_random(1090, 5),
      colors_at_random(3300, 14, 1000),
      colors_at_random(3300, 15, 4000),
      colors_at_random(3700, 16),
      colors_at_random(9000, 17),
      half_noise(6),
      half_noise(7),
      runs_of_noise(3, 12),
      runs_of_noise(9, 13),
      colors_at_random(30000, 8),
      patterns::draw(patterns::kNoise, kWidth, kHeight, PixelFormat::kRgba8, 9),
      patterns::draw(patterns::kGradient, kWidth, kHeight, PixelFormat::kRgba8, 10)};
  SurfaceEngine engine({}, {});
  FrameStatistics statistics;
  std::optional<Picture> before;
  patterns::Dice dice(11);
  for (int frame = 0; frame < 120; ++frame) {
    SCOPED_TRACE(frame);
    const Picture& picture = pictures[dice.below(static_cast<uint32_t>(pictures.size()))];
    engine.process(patterns::in_memory(picture).view(), statistics);
    expect_metrics(statistics.metrics, picture, before);
    before = picture;
  }
}

TEST(Metrics, OfAnotherSurfaceInTheSameThreadDoNotMix) {
  SurfaceEngine first({}, {}), second({}, {});
  FrameStatistics statistics;
  const Picture noise = half_noise(1), other = half_noise(2);
  first.process(patterns::in_memory(noise).view(), statistics);
  second.process(patterns::in_memory(other).view(), statistics);
  first.process(patterns::in_memory(other).view(), statistics);
  expect_metrics(statistics.metrics, other, noise);
  second.process(patterns::in_memory(noise).view(), statistics);
  expect_metrics(statistics.metrics, noise, other);
}

TEST(Metrics, ChangedPixelsAreCountedAndTheirBlocksNotedWhileTheFrameIsCopied) {
  const std::string_view target = simd_target();
  for (const std::string_view each : simd_targets()) {
    force_simd_target(each);
    for (const PixelFormat format :
         {PixelFormat::kRgba8, PixelFormat::kRgbx8, PixelFormat::kRgb565, PixelFormat::kRgb10a2})
      for (const ByteOrder order : {ByteOrder::kRgba, ByteOrder::kBgra})
        for (const uint32_t width : {1u, 7u, 16u, 33u, 67u}) {
          if (order == ByteOrder::kBgra && format != PixelFormat::kRgba8 && format != PixelFormat::kRgbx8)
            continue;
          const ByteOrder layout =
              format == PixelFormat::kRgb565 || format == PixelFormat::kRgb10a2 ? ByteOrder::kNative : order;
          Picture picture = patterns::draw(patterns::kNoise, width, 3, format, width);
          PixelPlane plane;
          plane.assign(patterns::MemorySurface(picture, format, layout, false, 3).view());
          EXPECT_EQ(plane.assign(patterns::MemorySurface(picture, format, layout, true, 0).view()), 0u);
          for (uint32_t x = 0; x < width; x += 13) picture.words[width + x] ^= 0x10;
          const patterns::MemorySurface now(picture, format, layout, false, 0);
          std::vector<uint8_t> changed_blocks(plane.blocks());
          plane.reshape(now.view());
          EXPECT_EQ(plane.assign_rows(now.view(), 0, 8, changed_blocks.data()), (width + 12) / 13);
          for (uint32_t bx = 0; bx < plane.blocks_x(); ++bx) {
            const uint32_t begin = bx * 8, end = std::min(begin + 8, width);
            const bool changes = (begin + 12) / 13 * 13 < end;  // the first multiple of 13 from there on
            EXPECT_EQ(changed_blocks[bx] != 0, changes) << bx;
          }
          for (uint32_t x = 0; x < width; ++x) EXPECT_EQ(plane.row(1)[x], picture.words[width + x]);
        }
  }
  force_simd_target(target);
}
