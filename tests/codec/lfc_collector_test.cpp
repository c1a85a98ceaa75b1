// LFC collector: slot for slot what the plain FVC holds, whatever comes.
#include "dcp/lfc_collector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "dcp/ccd.h"
#include "dcp/fvc.h"
#include "kernel_targets.h"
#include "pixels/pixel_kernels.h"
#include "tilepress/scheme.h"
#include "tilepress/simd.h"

using namespace tilepress;
using patterns::draw_block;

namespace {

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
        else if (pixel_kernels().split(pixels.data(), few) && fast.see_block(few))
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
