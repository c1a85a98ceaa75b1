// Probe kernels: every target returns what the plain kernel returns.
#include "dcp/probe_kernels.h"

#include <algorithm>
#include <bit>

#include "dcp/ccd.h"
#include "kernel_targets.h"
#include "pixels/pixel_kernels.h"

using namespace tilepress;
using patterns::BlockPixels;
using patterns::draw_block;
using patterns::on_every_target;

namespace {

constexpr int kRounds = 1000;
constexpr const ProbeKernels& kPlain = kPlainProbeKernels;

/// A table that holds every other colour of the block that finds its bucket empty.
ProbeTable table_of(const BlockPixels& pixels) {
  ProbeTable table;
  table.reset(256, true);
  for (uint32_t i = 0; i < pixels.size(); i += 2) {
    const uint32_t at = table.bucket(pixels[i]);
    if (table.colors[at] != table.filler(at)) continue;
    table.colors[at] = pixels[i];
    table.values[at] = i * 5;
  }
  for (uint32_t at = 0; at < table.size(); ++at)
    if (table.colors[at] == table.filler(at)) table.values[at] = kNotInCcd;
  return table;
}

/// Pixels of few colours, and some of colours that meet other colours in the table's buckets.
BlockPixels draw_pixels(patterns::Dice& dice) {
  BlockPixels pixels = draw_block(1 + dice.below(40), 1 + dice.below(8), dice);
  for (uint32_t& pixel : pixels)
    if (dice.below(8) == 0) pixel = dice.next();
  return pixels;
}

struct Found {
  std::array<uint16_t, 64> indices{};
  std::array<uint8_t, 16> widths{};
  bool operator==(const Found&) const = default;
};

}  // namespace

TEST(ProbeKernels, FindIsTheSameOnEveryTarget) {
  patterns::Dice dice(1);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const BlockPixels pixels = draw_pixels(dice);
    const ProbeTable table = table_of(draw_block(1 + dice.below(60), 2, dice));
    Found wanted;
    kPlain.find(pixels.data(), table, wanted.indices.data(), wanted.widths.data());
    on_every_target([&] {
      Found other;
      probe_kernels().find(pixels.data(), table, other.indices.data(), other.widths.data());
      ASSERT_EQ(other, wanted);
    });
  }
}

TEST(ProbeKernels, FindFewIsTheSameOnEveryTarget) {
  patterns::Dice dice(2);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const auto pixels = draw_block(1 + dice.below(6), 1 + dice.below(20), dice);
    FewColors few;
    if (!kPlainPixelKernels.split(pixels.data(), few)) continue;
    uint32_t values[FewColors::kMost];
    for (uint32_t& value : values) value = dice.below(5) == 0 ? kNotInCcd : dice.below(1024);
    Found wanted;
    kPlain.find_few(pixels.data(), few, values, wanted.indices.data(), wanted.widths.data());
    on_every_target([&] {
      Found other;
      probe_kernels().find_few(pixels.data(), few, values, other.indices.data(), other.widths.data());
      ASSERT_EQ(other, wanted);
    });
  }
}

TEST(ProbeKernels, MembersIsTheSameOnEveryTarget) {
  patterns::Dice dice(3);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const BlockPixels pixels = draw_pixels(dice);
    const ProbeTable table = table_of(draw_block(1 + dice.below(60), 2, dice));
    uint32_t crowded[8];
    uint32_t crowded_count = 0;
    for (const uint32_t pixel : pixels)
      if (crowded_count < dice.below(9) && !table.holds(pixel) &&
          std::find(crowded, crowded + crowded_count, pixel) == crowded + crowded_count)
        crowded[crowded_count++] = pixel;
    uint32_t wanted[64];
    const uint64_t known = kPlain.members(pixels.data(), table, crowded, crowded_count, wanted);
    on_every_target([&] {
      uint32_t places[64];
      ASSERT_EQ(probe_kernels().members(pixels.data(), table, crowded, crowded_count, places), known);
      ASSERT_TRUE(std::ranges::equal(places, wanted));
    });
  }
}

TEST(ProbeKernels, FindSmallestIsTheSameOnEveryTarget) {
  patterns::Dice dice(4);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    uint32_t counts[3 * 70 + 64];
    for (uint32_t& count : counts) count = dice.below(1u << dice.below(9));
    const Smallest wanted = kPlain.find_smallest(counts, 70);
    on_every_target([&] {
      const Smallest other = probe_kernels().find_smallest(counts, 70);
      ASSERT_EQ(other.at, wanted.at);
      ASSERT_EQ(other.smallest, wanted.smallest);
      ASSERT_EQ(other.second, wanted.second);
    });
  }
}

TEST(ProbeKernels, CompactIsTheSameOnEveryTarget) {
  patterns::Dice dice(5);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const auto pixels = draw_block(1 + dice.below(12), 1 + dice.below(20), dice);
    const uint64_t mask = uint64_t{dice.next()} << 32 | dice.next();
    const auto kept = static_cast<size_t>(std::popcount(mask));
    uint32_t packed[80];
    const uint64_t alike = kPlain.compact(pixels.data(), mask, pixels[5], packed);
    on_every_target([&] {
      uint32_t other[80];
      ASSERT_EQ(probe_kernels().compact(pixels.data(), mask, pixels[5], other), alike);
      ASSERT_TRUE(std::equal(packed, packed + kept, other));
    });
  }
}
