// RAS kernels: every target returns what the plain kernel returns.
#include "ras/ras_kernels.h"

#include <algorithm>

#include "kernel_targets.h"

using namespace tilepress;
using patterns::on_every_target;

namespace {

constexpr uint32_t kRounds = 3000;
constexpr const RasKernels& kPlain = kPlainRasKernels;

/// A block's samples with their border, and without it pixel by pixel.
struct Samples {
  int16_t bordered[kRasSamples] = {}, pixels[4 * kBlockPixels];

  /// From hardly any detail to as much as there is, in each plane. In two of three rounds channels have 8
  /// bits, else they are the widest samples.
  Samples(uint32_t round, patterns::Dice& dice) {
    const bool bytes = round % 3 != 0;
    const int32_t most = bytes ? 255 : kRasMostSample - 1, least = bytes ? 0 : 1 - kRasMostSample;
    for (uint32_t plane = 0; plane < 4; ++plane) {
      const uint32_t step = 1u << dice.below(bytes ? 9 : 13), rest = dice.below(8);
      auto value = static_cast<int32_t>(dice.below(256));
      for (uint32_t i = 0; i < kBlockPixels; ++i) {
        if (dice.below(8) >= rest)
          value =
              std::clamp(value + static_cast<int32_t>(dice.below(2 * step + 1)) - static_cast<int32_t>(step),
                         least, most);
        pixels[4 * i + plane] = static_cast<int16_t>(value);
        bordered[ras_sample_index(static_cast<int32_t>(i % 8), static_cast<int32_t>(i / 8)) + plane] =
            static_cast<int16_t>(value);
      }
    }
    fill_ras_border(bordered);
  }
};

}  // namespace

TEST(RasKernels, GroupsAreTheSameOnEveryTarget) {
  patterns::Dice dice(7);
  uint64_t long_groups = 0, zero_groups = 0;
  for (uint32_t round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const Samples samples(round, dice);
    RasGroups groups;
    kPlain.groups(samples.bordered, groups);
    on_every_target([&] {
      RasGroups other;
      ras_kernels().groups(samples.bordered, other);
      for (uint32_t at = 0; at < 4 * kSubBlocks; ++at) {
        for (uint32_t i = 0; i < 4; ++i) ASSERT_EQ(other.residuals[i][at], groups.residuals[i][at]);
        ASSERT_EQ(other.k[at], groups.k[at]);
        ASSERT_EQ(other.lengths[at], groups.lengths[at]);
        ASSERT_TRUE(groups.lengths[at] > kMaxBitsPerCall || other.codes[at] == groups.codes[at]);
        long_groups += groups.lengths[at] > kMaxBitsPerCall;
        zero_groups += groups.k[at] == kRasZeroGroup;
      }
    });
  }
  EXPECT_GT(long_groups, 1000u);
  EXPECT_GT(zero_groups, 1000u);
}

TEST(RasKernels, CodeBitsIsTheSumOfTheGroupsOnEveryTarget) {
  patterns::Dice dice(8);
  for (uint32_t round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const Samples samples(round, dice);
    RasGroups groups;
    kPlain.groups(samples.bordered, groups);
    uint64_t bits = 0;
    for (const uint64_t length : groups.lengths) bits += length;
    on_every_target([&] { ASSERT_EQ(ras_kernels().code_bits(samples.bordered), bits); });
  }
}

TEST(RasKernels, RestoreReturnsTheSamplesOnEveryTarget) {
  patterns::Dice dice(9);
  for (uint32_t round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const Samples samples(round, dice);
    RasGroups groups;
    kPlain.groups(samples.bordered, groups);
    int16_t residuals[4 * kBlockPixels];  // by place; the first pixel as it is
    for (uint32_t plane = 0; plane < 4; ++plane) {
      for (uint32_t group = 0; group < kSubBlocks; ++group)
        for (uint32_t i = 0; i < 4; ++i) {
          const uint32_t u = groups.residuals[i][ras_group_index(plane, group)];
          const auto half = static_cast<int32_t>(u / 2);
          residuals[4 * kTraversal[4 * group + i] + plane] =
              static_cast<int16_t>(u % 2 != 0 ? -half - 1 : half);
        }
      residuals[plane] = samples.pixels[plane];
    }
    on_every_target([&] {
      int16_t restored[4 * kBlockPixels];
      std::ranges::copy(residuals, restored);
      ras_kernels().restore(restored);
      ASSERT_TRUE(std::ranges::equal(restored, samples.pixels));
    });
  }
}

TEST(RasKernels, NarrowBytesJoinsChannelsOnEveryTarget) {
  patterns::Dice dice(10);
  for (uint32_t round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const Samples samples(round, dice);
    const bool fit =
        std::ranges::all_of(samples.pixels, [](int16_t sample) { return sample >= 0 && sample < 256; });
    on_every_target([&] {
      Block block;
      ASSERT_EQ(ras_kernels().narrow_bytes(samples.pixels, block.pixels.data()), fit);
      for (uint32_t i = 0; fit && i < 4 * kBlockPixels; ++i)
        ASSERT_EQ(block.pixels[i / 4] >> (8 * (i % 4)) & 0xFF, static_cast<uint32_t>(samples.pixels[i]));
    });
  }
}

TEST(RasKernels, WidenBytesSplitsChannelsOnEveryTarget) {
  patterns::Dice dice(11);
  for (uint32_t round = 0; round < 500 && !HasFatalFailure(); ++round) {
    constexpr uint32_t kStride = 11;
    uint32_t plane[8 * kStride];
    for (uint32_t& word : plane) word = dice.next();
    on_every_target([&] {
      int16_t samples[kRasSamples] = {};
      ras_kernels().widen_bytes(plane, kStride, samples);
      for (int32_t i = 0; i < 256; ++i)
        ASSERT_EQ(static_cast<uint32_t>(samples[ras_sample_index(i / 4 % 8, i / 32) + i % 4]),
                  plane[static_cast<uint32_t>(i / 32) * kStride + static_cast<uint32_t>(i / 4 % 8)] >>
                          (8 * (i % 4)) &
                      0xFF);
    });
  }
}
