// LFC collector: slot for slot what the plain FVC holds, whatever comes.
#include "dcp/lfc_collector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>

#include "dcp/ccd.h"
#include "dcp/fvc.h"
#include "simd/kernels.h"
#include "surface_patterns.h"
#include "tilepress/scheme.h"
#include "tilepress/simd.h"

using namespace tilepress;

namespace {

/// 64 pixels of one of `colors` colours each, in runs of up to `longest_run`.
std::array<uint32_t, kBlockPixels> draw_block(uint32_t colors, uint32_t longest_run, patterns::Dice& dice) {
  std::array<uint32_t, kBlockPixels> pixels;
  for (uint32_t i = 0; i < kBlockPixels;) {
    // Squared: some colours far more often than others.
    const uint64_t at = dice.below(1u << 16), color = at * at % (uint64_t{colors} << 16) >> 16;
    for (uint32_t run = 1 + dice.below(longest_run); run > 0 && i < kBlockPixels; --run)
      pixels[i++] = static_cast<uint32_t>(color) * 0x01000193u;
  }
  return pixels;
}

std::string differences(const Fvc& plain, const Fvc& fast) {
  std::string text;
  for (uint32_t slot = 0; slot < plain.slots(); ++slot)
    if (plain.valid(slot) != fast.valid(slot) ||
        (plain.valid(slot) &&
         (plain.color(slot) != fast.color(slot) || plain.count(slot) != fast.count(slot))))
      text += " " + std::to_string(slot);
  if (plain.samples() != fast.samples()) text += " samples";
  return text;
}

struct Counter final : ColorListener {
  std::map<uint32_t, uint64_t> counts;
  void see_run(uint32_t color, uint32_t count) override { counts[color] += count; }
  void see_pixels(const uint32_t* pixels, uint32_t count, uint64_t alike) override {
    for (uint32_t i = 0; i < count; ++i) {
      ++counts[pixels[i]];
      EXPECT_TRUE(i == 0 || (alike >> i & 1) == 0 || pixels[i] == pixels[i - 1]);
    }
  }
};

}  // namespace

TEST(LfcCollector, TellsOfEveryPixelOnce) {
  const std::string_view target = simd_target();
  for (const std::string_view each : simd_targets()) {
    force_simd_target(each);
    for (const uint32_t entries : {2u, 64u, 128u}) {
      patterns::Dice dice(entries);
      LfcCollector collector(entries);
      for (uint32_t frame = 0; frame < 20; ++frame) {
        Counter told, seen;
        collector.reset();
        collector.listen(&told);
        for (uint32_t block = 0; block < 200; ++block) {
          constexpr uint32_t kColors[] = {1, 2, 5, 20, 70, 130, 300, 60000};
          const auto pixels = draw_block(kColors[dice.below(8)], 1 + dice.below(12), dice);
          for (const uint32_t pixel : pixels) ++seen.counts[pixel];
          if (std::count(pixels.begin(), pixels.end(), pixels[0]) == kBlockPixels)
            collector.see_run(pixels[0], kBlockPixels);
          else
            collector.see_block(pixels.data());
        }
        collector.tell_held();
        ASSERT_EQ(told.counts, seen.counts) << each << ", " << entries << " entries, frame " << frame;
      }
    }
  }
  force_simd_target(target);
}

TEST(LfcCollector, HoldsWhatThePlainFvcHolds) {
  const std::string_view target = simd_target();
  const FormatTraits& format = traits(PixelFormat::kRgba8);
  for (const std::string_view each : simd_targets()) {
    force_simd_target(each);
    for (const uint32_t entries : {2u, 4u, 16u, 64u, 128u}) {
      patterns::Dice dice(entries);
      FvcConfig config;
      config.entries = entries;
      Fvc plain(config, format), fast_slots(config, format);
      LfcCollector fast(entries);
      uint64_t few_taken = 0;
      for (uint32_t block = 0; block < 4000; ++block) {
        if (block % 500 == 0) {
          plain.reset();
          fast.reset();
        }
        constexpr uint32_t kColors[] = {1, 2, 5, 20, 70, 130, 300, 60000};
        const auto pixels = draw_block(kColors[dice.below(8)], 1 + dice.below(12), dice);
        plain.see_all(pixels.data(), kBlockPixels);
        FewColors few;
        if (std::count(pixels.begin(), pixels.end(), pixels[0]) == kBlockPixels)
          fast.see_run(pixels[0], kBlockPixels);
        else if (kernels().split(pixels.data(), few) && fast.see_block(few))
          ++few_taken;
        else
          fast.see_block(pixels.data());
        if (block % 7 != 0) continue;
        fast.store_to(fast_slots);
        ASSERT_EQ(differences(plain, fast_slots), "")
            << each << ", " << entries << " entries, block " << block;
      }
      EXPECT_TRUE(entries < 16 || few_taken > 100);  // that way was tried, too
    }
  }
  force_simd_target(target);
}

TEST(Kernels, ThatTakeABlockApartAgreeOnEveryTarget) {
  const std::string_view target = simd_target();
  patterns::Dice dice(3);
  uint32_t all_indices = 0;
  for (int round = 0; round < 3000; ++round) {
    const auto pixels = draw_block(1 + dice.below(12), 1 + dice.below(20), dice);
    const uint64_t mask = uint64_t{dice.next()} << 32 | dice.next();
    force_simd_target("scalar");
    FewColors few, other_few;
    const bool is_few = kernels().split(pixels.data(), few);
    uint32_t packed[80] = {}, other_packed[80] = {};
    const uint64_t alike = kernels().compact(pixels.data(), mask, pixels[5], packed);
    const auto kept = static_cast<size_t>(std::popcount(mask));
    const uint64_t begins = kernels().run_begins(pixels.data());
    const uint64_t places = kernels().places_of(pixels.data(), pixels[7]);
    uint32_t counts[3 * 70 + 64];
    for (uint32_t& count : counts) count = dice.below(1u << dice.below(9));
    const Smallest smallest = kernels().find_smallest(counts, 70);
    uint16_t indices[64];
    uint8_t widths[16];
    uint32_t words[16], other_words[16];
    for (uint16_t& index : indices) index = static_cast<uint16_t>(dice.below(1u << dice.below(9)));
    for (uint32_t s = 0; s < 16; ++s)
      widths[s] = s % 4 == 1 ? kRawWidth : width_of(*std::max_element(indices + 4 * s, indices + 4 * s + 4));
    kernels().pack(indices, widths, words);
    const uint32_t limit = dice.below(11);
    uint8_t written[256], other_written[256];
    std::ranges::fill(written, uint8_t{0xAA});
    uint8_t few_widths[16];  // and indices that fit
    uint16_t few_indices[64];
    const uint32_t raw_share = dice.below(5);
    for (uint32_t s = 0; s < 16; ++s) {
      few_widths[s] = dice.below(4) < raw_share ? kRawWidth : static_cast<uint8_t>(dice.below(8));
      for (uint32_t i = 4 * s; i < 4 * s + 4; ++i)
        few_indices[i] = few_widths[s] == kRawWidth ? kNotInCcd : indices[i] & ((1u << few_widths[s]) - 1);
    }
    constexpr uint32_t kRow = 8 * 9;  // nine blocks side by side
    uint32_t row[8 * kRow];
    std::ranges::fill(row, pixels[0]);
    if (round % 4 != 0) row[dice.below(8 * kRow)] = dice.next();
    const uint32_t most = 1 + dice.below(9);
    const uint32_t solid = kernels().solid_blocks(row, kRow, row[0], most);
    const uint32_t mark_bits = 3 + dice.below(5);
    const WrittenBlock block =
        kernels().write_sub_blocks(pixels.data(), few_indices, few_widths, mark_bits, written);
    uint8_t no_raw_widths[16], no_raw_written[256];
    uint16_t low_indices[64];
    for (uint32_t s = 0; s < 16; ++s) {
      no_raw_widths[s] = static_cast<uint8_t>(dice.below(3 + raw_share));
      for (uint32_t i = 4 * s; i < 4 * s + 4; ++i)
        low_indices[i] = indices[i] & ((1u << no_raw_widths[s]) - 1);
    }
    WrittenBlock no_raw =
        kernels().write_sub_blocks(pixels.data(), low_indices, no_raw_widths, mark_bits, no_raw_written);
    const bool hostile = round % 3 == 0;
    if (hostile) no_raw.marks[0] = uint64_t{dice.next()} << 32 | dice.next();
    const uint32_t most_bits = round % 2 == 0 ? 6 : 1 + dice.below(7);
    const uint32_t known = round % 5 != 0 ? 64 : dice.below(65);
    uint32_t raster[64];
    const uint32_t indices_read = kernels().read_indices(no_raw_written, no_raw.marks, mark_bits, most_bits,
                                                         pixels.data(), known, raster);
    if (!hostile && indices_read != kNotAllIndices) {
      ++all_indices;
      ASSERT_EQ(indices_read, no_raw.bits);
      for (uint32_t i = 0; i < 64; ++i) ASSERT_EQ(raster[kTraversal[i]], pixels[low_indices[i]]);
    }
    uint8_t raw_bytes[256];
    for (uint8_t& byte : raw_bytes) byte = static_cast<uint8_t>(dice.next());
    uint8_t slots[64];
    for (uint8_t& slot : slots) slot = static_cast<uint8_t>(dice.below(1 + dice.below(64)));
    std::array<uint32_t, 64> counted{};
    const uint64_t left = kernels().count_slots(slots, mask, counted.data());
    uint8_t lengths[64];
    uint16_t coded[64];
    for (uint8_t& length : lengths) length = static_cast<uint8_t>(1 + dice.below(63));
    for (uint16_t& index : coded)
      index = dice.below(8) < raw_share ? kNotInCcd : static_cast<uint16_t>(dice.below(64));
    const uint32_t code_sum = kernels().code_sum(coded, lengths, 64u << round % 2);
    const uint32_t narrow = kernels().count_up_to(widths, limit);
    for (const std::string_view each : simd_targets()) {
      SCOPED_TRACE(each);
      force_simd_target(each);
      ASSERT_EQ(kernels().split(pixels.data(), other_few), is_few);
      if (is_few) {
        ASSERT_EQ(few.count, other_few.count);
        ASSERT_TRUE(std::equal(few.colors, few.colors + few.count, other_few.colors));
        ASSERT_TRUE(std::equal(few.places, few.places + few.count, other_few.places));
      }
      ASSERT_EQ(kernels().compact(pixels.data(), mask, pixels[5], other_packed), alike);
      ASSERT_TRUE(std::equal(packed, packed + kept, other_packed));
      ASSERT_EQ(kernels().run_begins(pixels.data()), begins);
      ASSERT_EQ(kernels().places_of(pixels.data(), pixels[7]), places);
      const Smallest other_smallest = kernels().find_smallest(counts, 70);
      ASSERT_EQ(other_smallest.at, smallest.at);
      ASSERT_EQ(other_smallest.smallest, smallest.smallest);
      ASSERT_EQ(other_smallest.second, smallest.second);
      kernels().pack(indices, widths, other_words);
      std::ranges::fill(other_written, uint8_t{0xBB});
      const WrittenBlock other =
          kernels().write_sub_blocks(pixels.data(), few_indices, few_widths, mark_bits, other_written);
      ASSERT_EQ(other.bits, block.bits);
      ASSERT_EQ(other.clean_bytes, block.clean_bytes);
      ASSERT_TRUE(std::ranges::equal(other.marks, block.marks));
      ASSERT_TRUE(std::equal(written, written + block.clean_bytes, other_written));
      uint32_t other_raster[64];
      ASSERT_EQ(kernels().read_indices(no_raw_written, no_raw.marks, mark_bits, most_bits, pixels.data(),
                                       known, other_raster),
                indices_read);
      ASSERT_TRUE(indices_read == kNotAllIndices || std::ranges::equal(raster, other_raster));
      kernels().read_raw(raw_bytes, other_raster);
      for (uint32_t i = 0; i < 64; ++i) {
        const uint8_t* at = raw_bytes + 4 * i;
        ASSERT_EQ(other_raster[kTraversal[i]],
                  uint32_t{at[0]} << 24 | uint32_t{at[1]} << 16 | uint32_t{at[2]} << 8 | at[3]);
      }
      std::array<uint32_t, 64> other_counted{};
      ASSERT_EQ(kernels().count_slots(slots, mask, other_counted.data()), left);
      ASSERT_EQ(other_counted, counted);
      ASSERT_EQ(kernels().code_sum(coded, lengths, 64u << round % 2), code_sum);
      ASSERT_EQ(kernels().count_up_to(widths, limit), narrow);
      for (uint32_t sub = 0; sub < 16; ++sub)
        ASSERT_TRUE(widths[sub] == kRawWidth || words[sub] == other_words[sub]);
      ASSERT_EQ(kernels().solid_blocks(row, kRow, row[0], most), solid);
    }
  }
  force_simd_target(target);
  EXPECT_GT(all_indices, 1000u);
}
