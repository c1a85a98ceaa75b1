// Color histogram: against plain maps, frame after frame, however full its table gets.
#include "statistics/color_histogram.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

#include "kernel_targets.h"
#include "statistics/histogram_kernels.h"

using namespace tilepress;

namespace {

constexpr uint32_t kMostPlaces = 1024;

struct Counts {
  uint64_t now, before;
  auto operator<=>(const Counts&) const = default;
};

/// Other colours in place of some, of which the first stays 0; those of some frames in a part of the table
/// only.
void change_some(std::vector<uint32_t>& colors, patterns::Dice& dice) {
  const uint32_t share = 1 + dice.below(16), one_in = 1 + dice.below(8);
  colors.resize(1 + dice.below(1u << dice.below(13)));
  for (size_t i = 1; i < colors.size(); ++i)
    while (colors[i] == 0 || (dice.below(one_in) == 0 && ColorBucket::of(colors[i], 17) + share <= 16))
      colors[i] = dice.next();
}

/// A frame of runs, by add() and by add_runs() by turns, into both. False if the table had no room.
bool add_frame(ColorHistogram& histogram, std::map<uint32_t, uint64_t>& counts,
               const std::vector<uint32_t>& colors, patterns::Dice& dice) {
  for (uint32_t block = dice.below(200); block < 210; ++block) {
    uint32_t pixels[64];
    uint64_t begins = 0;
    const uint32_t end = 1 + dice.below(64);
    for (uint32_t i = 0; i < end; ++i) {
      const bool begin = i == 0 || dice.below(3) != 0;
      pixels[i] = begin ? colors[dice.below(static_cast<uint32_t>(colors.size()))] : pixels[i - 1];
      begins |= uint64_t{begin} << i;
      ++counts[pixels[i]];
    }
    if (block % 4 != 0) {
      if (!histogram.add_runs(pixels, begins, end)) return false;
    } else {
      for (uint32_t i = 0; i < end; ++i)
        if (!histogram.add(pixels[i], 1)) return false;
    }
  }
  return true;
}

}  // namespace

TEST(ColorHistogram, CountsAFrameAndTheOneBefore) {
  const std::string_view target = simd_target();
  for (const std::string_view each : simd_targets()) {
    force_simd_target(each);
    patterns::Dice dice(21);
    ColorHistogram histogram;
    histogram.clear(kMostPlaces);
    std::map<uint32_t, uint64_t> before;
    std::vector<uint32_t> colors;
    uint32_t refused = 0;
    for (int frame = 0; frame < 200; ++frame) {
      SCOPED_TRACE(frame);
      change_some(colors, dice);
      std::map<uint32_t, uint64_t> counts;
      const bool room = add_frame(histogram, counts, colors, dice);
      std::map<uint32_t, uint64_t> known_before;
      histogram.for_each_before([&](uint32_t color, uint32_t count) { known_before[color] += count; });
      ASSERT_EQ(known_before, before);
      if (!room) {
        ++refused;
        ASSERT_GT(counts.size() + before.size(), kMostPlaces / 4 * 3);
        histogram.clear(kMostPlaces);
        before.clear();
        continue;
      }
      for (const uint32_t color : colors)
        ASSERT_EQ(histogram.count(color), counts.contains(color) ? counts[color] : 0);
      std::multiset<Counts> expected, visited;
      for (const auto& [color, count] : counts)
        expected.insert({count, before.contains(color) ? before[color] : 0});
      for (const auto& [color, count] : before)
        if (!counts.contains(color)) expected.insert({0, count});
      histogram.end_frame([&](uint32_t now, uint32_t last) {
        if (now != 0 || last != 0) visited.insert({now, last});
      });
      ASSERT_EQ(visited, expected);
      before = counts;
    }
    EXPECT_GT(refused, 5u);
    EXPECT_LT(refused, 200u);
  }
  force_simd_target(target);
}

TEST(ColorHistogram, OfAFewColoursStaysSmallHoweverManyCameBefore) {
  ColorHistogram histogram;
  histogram.clear(kMostPlaces);
  uint32_t next = 1;
  // Three eighths of the places: this frame and the one before fit, three frames would not.
  for (int frame = 0; frame < 1000; ++frame) {
    for (int i = 0; i < 384; ++i) ASSERT_TRUE(histogram.add(next++ * 0x01000193u, 1)) << frame;
    histogram.end_frame([](uint32_t, uint32_t) {});
  }
}

TEST(HistogramKernels, CountRunsIsTheSameOnEveryTarget) {
  patterns::Dice dice(22);
  constexpr size_t kBuckets = 9;
  for (int round = 0; round < 1000 && !HasFatalFailure(); ++round) {
    const auto pixels = patterns::draw_block(1 + dice.below(40), 1 + dice.below(8), dice);
    const uint32_t end = 1 + dice.below(64);
    uint64_t begins = 1;
    for (uint32_t i = 1; i < end; ++i) begins |= uint64_t{pixels[i] != pixels[i - 1]} << i;
    std::vector<ColorBucket> table(kBuckets, ColorBucket{});
    for (uint32_t i = 0; i < end; i += 3) {  // some of the colours
      ColorBucket& bucket = table[ColorBucket::of(pixels[i], kBuckets)];
      if (bucket.find(pixels[i]) != ColorBucket::kPlaces) continue;
      if (const uint32_t place = bucket.find(0); place != ColorBucket::kPlaces)
        bucket.colors[place] = pixels[i];
    }
    const auto counts_after = [&](const HistogramKernels& kernels, uint64_t& others) {
      std::vector<ColorBucket> counted = table;
      others = kernels.count_runs(pixels.data(), begins, end, counted.data(), kBuckets);
      std::vector<uint32_t> counts;
      for (const ColorBucket& bucket : counted) counts.insert(counts.end(), bucket.counts, bucket.counts + 8);
      return counts;
    };
    uint64_t others = 0;
    const auto wanted = counts_after(kPlainHistogramKernels, others);
    patterns::on_every_target([&] {
      uint64_t other_others = 0;
      ASSERT_EQ(counts_after(histogram_kernels(), other_others), wanted);
      ASSERT_EQ(other_others, others);
    });
  }
}
