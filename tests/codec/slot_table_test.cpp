// Slot table: what was put in is found, by itself and by the kernels of every target; nothing else is.
#include "dcp/slot_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <unordered_map>

#include "dcp/ccd.h"
#include "dcp/slot_kernels.h"
#include "kernel_targets.h"

using namespace tilepress;

namespace {

/// Colours that share one bucket, and three others.
std::array<uint32_t, 64> crowded_colors() {
  std::array<uint32_t, 64> colors;
  uint32_t found = 0;
  for (uint32_t color = 0; found < 64; ++color)
    if (SlotBuckets::of(color, 0) == 5 && SlotBuckets::of(color, 1) < 3) colors[found++] = color;
  return colors;
}

void expect_agreement(const SlotTable& table, const std::unordered_map<uint32_t, uint32_t>& held,
                      const std::array<uint32_t, kBlockPixels>& pixels) {
  std::array<uint16_t, kBlockPixels> wanted;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const auto at = held.find(pixels[i]);
    wanted[i] = at == held.end() ? kNotInCcd : static_cast<uint16_t>(at->second);
    ASSERT_EQ(table.find(pixels[i]), at == held.end() ? SlotTable::kAbsent : at->second);
  }
  const std::string_view target = simd_target();
  for (const std::string_view each : simd_targets()) {
    SCOPED_TRACE(each);
    force_simd_target(each);
    std::array<uint32_t, kBlockPixels> traversed;
    uint32_t raster[kBlockPixels];
    for (uint32_t i = 0; i < kBlockPixels; ++i) raster[kTraversal[i]] = pixels[i];
    std::array<uint16_t, kBlockPixels> indices;
    uint8_t widths[kSubBlocks];
    MemberLookup members{&table, {}, {}};
    const SlotLookups lookups{{{&table, indices.data(), widths}}, {&members}};
    const auto& slots = members.slots;
    const bool uniform = slot_kernels().load(raster, kBlockSide, traversed.data(), lookups);
    ASSERT_EQ(traversed, pixels);
    ASSERT_EQ(uniform, std::count(pixels.begin(), pixels.end(), pixels[0]) == kBlockPixels);
    if (uniform) continue;
    ASSERT_EQ(indices, wanted);
    for (uint32_t i = 0; i < kBlockPixels; ++i) {
      ASSERT_EQ(slots[i], wanted[i] == kNotInCcd ? SlotTable::kAbsent : wanted[i]);
      ASSERT_EQ(members.found.known >> i & 1, wanted[i] != kNotInCcd);
      const bool other =
          i == 0 || (members.found.known != 0 ? slots[i] != slots[i - 1] : pixels[i] != pixels[i - 1]);
      ASSERT_EQ(members.found.begins >> i & 1, other);
    }
    uint8_t slots_alone[kBlockPixels];
    const FoundSlots found = slot_kernels().find(pixels.data(), table, slots_alone);
    ASSERT_TRUE(std::ranges::equal(slots, slots_alone));
    ASSERT_EQ(found.known, members.found.known);
    ASSERT_EQ(found.begins, members.found.begins);
    indices.fill(1);
    std::ranges::fill(widths, 1);
    slot_kernels().index(pixels.data(), table, indices.data(), widths);
    ASSERT_EQ(indices, wanted);
    for (uint32_t sub = 0; sub < kSubBlocks; ++sub)
      ASSERT_EQ(widths[sub], width_of(*std::max_element(&wanted[4 * sub], &wanted[4 * sub] + 4)));
  }
  force_simd_target(target);
}

}  // namespace

TEST(SlotTable, FindsWhatItHolds) {
  patterns::Dice dice(11);
  const auto crowded = crowded_colors();
  SlotTable table;
  std::unordered_map<uint32_t, uint32_t> held;
  std::array<uint32_t, 64> colors{};
  uint64_t used = 0;
  for (int step = 0; step < 20000; ++step) {
    if (step % 4000 == 0) {
      table.clear();
      held.clear();
      used = 0;
    }
    const auto slot = static_cast<uint32_t>(dice.below(64));
    if ((used >> slot & 1) != 0) {
      table.remove(slot);
      held.erase(colors[slot]);
      used &= ~(uint64_t{1} << slot);
    } else if (dice.below(4) != 0) {  // three quarters full
      const bool hard = step % 4000 < 1000;
      const uint32_t color = hard ? crowded[dice.below(64)] : dice.next() % 5 == 0 ? 0 : dice.next();
      if (held.contains(color)) continue;
      table.insert(slot, color);
      colors[slot] = color;
      held[color] = slot;
      used |= uint64_t{1} << slot;
    }
    if (step % 5 != 0) continue;
    std::array<uint32_t, kBlockPixels> pixels;
    if (step % 50 == 0) {  // nothing of it is held, and some are alike
      for (uint32_t i = 0; i < kBlockPixels; ++i)
        pixels[i] = i > 0 && dice.below(3) == 0 ? pixels[i - 1] : dice.next() | 1u << 31;
      ASSERT_NO_FATAL_FAILURE(expect_agreement(table, held, pixels)) << "step " << step;
    }
    for (uint32_t& pixel : pixels) {
      pixel = colors[dice.below(64)];
      if (dice.below(4) == 0) pixel ^= 1u << dice.below(32);
      if (dice.below(4) == 0) pixel = crowded[dice.below(64)];
    }
    ASSERT_NO_FATAL_FAILURE(expect_agreement(table, held, pixels)) << "step " << step;
  }
}

TEST(SlotKernels, CountIsTheSameOnEveryTarget) {
  patterns::Dice dice(12);
  for (int round = 0; round < 1000 && !HasFatalFailure(); ++round) {
    uint8_t slots[64];
    for (uint8_t& slot : slots) slot = static_cast<uint8_t>(dice.below(1 + dice.below(64)));
    const uint64_t wanted = uint64_t{dice.next()} << 32 | dice.next();
    std::array<uint32_t, 64> counts{};
    uint64_t left = wanted;  // slot by slot, four of them
    for (int n = 0; n < 4 && left != 0; ++n) {
      const uint8_t slot = slots[std::countr_zero(left)];
      for (uint32_t i = 0; i < 64; ++i)
        if ((left >> i & 1) != 0 && slots[i] == slot) {
          ++counts[slot];
          left &= ~(uint64_t{1} << i);
        }
    }
    patterns::on_every_target([&] {
      std::array<uint32_t, 64> other{};
      ASSERT_EQ(slot_kernels().count(slots, wanted, other.data()), left);
      ASSERT_EQ(other, counts);
    });
  }
}

TEST(SlotTable, NoTwoShadesOfTheSameChannelsHaveBothBucketsInCommon) {
  for (uint32_t channels = 1; channels < 16; ++channels) {
    uint32_t ones = 0;
    for (uint32_t c = 0; c < 4; ++c) ones |= (channels >> c & 1) << 8 * c;
    std::unordered_map<uint32_t, uint32_t> shades;
    for (uint32_t shade = 0; shade < 256; ++shade) {
      const uint32_t color = ones * shade;
      const uint32_t both = SlotBuckets::of(color, 0) * SlotTable::kBuckets + SlotBuckets::of(color, 1);
      EXPECT_TRUE(shades.emplace(both, shade).second)
          << shade << " and " << shades[both] << " of " << channels;
    }
  }
}

TEST(SlotTable, StashesWhatFindsNoBucket) {
  const auto crowded = crowded_colors();  // of four buckets at most
  SlotTable table;
  std::unordered_map<uint32_t, uint32_t> held;
  for (uint32_t slot = 0; slot < 64; ++slot) {
    table.insert(slot, crowded[slot]);
    held[crowded[slot]] = slot;
  }
  EXPECT_EQ(std::popcount(table.stashed), 60);
  std::array<uint32_t, kBlockPixels> pixels;
  std::copy(crowded.begin(), crowded.end(), pixels.begin());
  expect_agreement(table, held, pixels);
  for (uint32_t slot = 0; slot < 60; ++slot) {
    table.remove(slot);
    held.erase(crowded[slot]);
  }
  EXPECT_LT(std::popcount(table.stashed), 4);  // who waited took what became free
  expect_agreement(table, held, pixels);
}
