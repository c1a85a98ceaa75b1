// Collectors: in every configuration, slot for slot what the plain FVC holds, whatever comes.
#include "dcp/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "fvc_differences.h"
#include "kernel_targets.h"
#include "pixels/pixel_kernels.h"

using namespace tilepress;

namespace {

constexpr uint32_t kSizes[] = {2, 4, 8, 16, 32, 64, 128, 256, 512, 1024};

/// A stream of pixels, drawn block by block.
class Stream {
 public:
  Stream(uint64_t seed, uint32_t entries) : dice_(seed), entries_(entries) {}
  /// Returns up to 64 pixels: of few colours, or of about as many as the FVC holds, or of very many; or a
  /// colour each in turn, which hits the slot evicted last; or the last colours once more.
  std::vector<uint32_t> next() {
    if (dice_.below(20) == 0) colors_ = 1 + dice_.below(2 + dice_.below(4 * entries_));
    const uint32_t kind = dice_.below(8);
    if (kind == 0 && !last_.empty()) {
      std::reverse(last_.begin(), last_.end());
      return last_;
    }
    const auto block = patterns::draw_block(kind == 1 ? 60000 : colors_, 1 + dice_.below(12), dice_);
    last_.assign(block.begin(), block.begin() + (dice_.below(6) == 0 ? 1 + dice_.below(64) : 64));
    if (kind == 2)
      for (uint32_t& pixel : last_) pixel = turn_++ / 2 % (entries_ + 2) * 0x00010203u;
    return last_;
  }

 private:
  patterns::Dice dice_;
  const uint32_t entries_;
  uint32_t colors_ = 3, turn_ = 0;
  std::vector<uint32_t> last_;
};

void show(Collector& collector, const std::vector<uint32_t>& pixels) {
  const auto count = static_cast<uint32_t>(pixels.size());
  if (std::count(pixels.begin(), pixels.end(), pixels[0]) == count)
    return collector.see_run(pixels[0], count);
  std::array<uint32_t, kBlockPixels> block{};
  std::copy(pixels.begin(), pixels.end(), block.begin());
  FewColors few;
  const bool is_few = count == kBlockPixels && pixel_kernels().split(block.data(), few);
  collector.see({.pixels = block.data(),
                 .count = count,
                 .found = false,
                 .few = is_few ? &few : nullptr,
                 .begins = collector.wants_runs() ? pixel_kernels().run_begins(block.data()) : 0});
}

/// Counts what it is told.
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

/// Compares a collector with the plain FVC at several moments of `frames` frames.
void expect_the_same(const FvcConfig& config, PixelFormat format, uint64_t seed, uint32_t frames) {
  Collector collector(config, traits(format));
  Fvc plain(config, traits(format));
  Stream stream(seed, config.entries);
  patterns::Dice dice(seed);
  for (uint32_t frame = 0; frame < frames; ++frame) {
    collector.begin_frame();
    plain.reset();
    for (uint32_t left = dice.below(200 + 2 * config.entries); left > 0; --left) {
      const std::vector<uint32_t> pixels = stream.next();
      plain.see_all(pixels.data(), static_cast<uint32_t>(pixels.size()));
      show(collector, pixels);
      if (left % 64 != 1) continue;
      collector.end_frame();
      ASSERT_EQ(fvc_differences(plain, collector.fvc()), "") << "frame " << frame << ", " << left << " left";
    }
  }
}

}  // namespace

TEST(Collector, HoldsWhatThePlainFvcHoldsForEverySizePolicyAndAssociativity) {
  uint64_t seed = 1;
  for (const uint32_t entries : kSizes)
    for (uint32_t ways = 1; ways <= entries; ways *= 2)
      for (const FvcPolicy policy :
           {FvcPolicy::kLfc, FvcPolicy::k2Lfc, FvcPolicy::kLru, FvcPolicy::kRandom}) {
        SCOPED_TRACE(testing::Message()
                     << entries << " entries, " << ways << " ways, policy " << int(policy));
        expect_the_same({.entries = entries, .policy = policy, .ways = ways == entries ? 0 : ways},
                        PixelFormat::kRgba8, ++seed, 3);
        if (HasFatalFailure()) return;
      }
}

RC_GTEST_PROP(Collector, HoldsWhatThePlainFvcHoldsOnEveryTarget, ()) {
  const uint32_t entries = *rc::gen::elementOf(std::vector<uint32_t>(std::begin(kSizes), std::end(kSizes)));
  FvcConfig config{.entries = entries, .policy = static_cast<FvcPolicy>(*rc::gen::inRange(0, 4))};
  config.ways = entries >> *rc::gen::inRange<uint32_t>(0, static_cast<uint32_t>(std::bit_width(entries)));
  config.sample = *rc::gen::elementOf(std::vector<uint32_t>{1, 1, 1, 2, 3, 4, 16, 63, 64, 65, 100, 16384});
  const auto format = *rc::gen::element(PixelFormat::kRgba8, PixelFormat::kRgb565, PixelFormat::kRgb10a2);
  const auto seed = *rc::gen::arbitrary<uint64_t>();
  patterns::on_every_target([&] { expect_the_same(config, format, seed, 2); });
  RC_ASSERT(!testing::Test::HasFatalFailure());
}

TEST(Collector, ReportsEveryPixelOnce) {
  patterns::on_every_target([] {
    for (const FvcConfig& config : {FvcConfig{.entries = 2}, FvcConfig{}, FvcConfig{.entries = 128},
                                    FvcConfig{.policy = FvcPolicy::kLru}, FvcConfig{.ways = 4}}) {
      patterns::Dice dice(config.entries);
      Collector collector(config, traits(PixelFormat::kRgba8));
      for (uint32_t frame = 0; frame < 20; ++frame) {
        Counter told, seen;
        collector.begin_frame();
        if (!collector.listen(&told)) break;
        for (uint32_t block = 0; block < 200; ++block) {
          constexpr uint32_t kColors[] = {1, 2, 5, 20, 70, 130, 300, 60000};
          const auto pixels = patterns::draw_block(kColors[dice.below(8)], 1 + dice.below(12), dice);
          for (const uint32_t pixel : pixels) ++seen.counts[pixel];
          show(collector, {pixels.begin(), pixels.end()});
        }
        collector.end_frame();
        ASSERT_EQ(told.counts, seen.counts) << config.entries << " entries, frame " << frame;
      }
    }
  });
}

TEST(Collector, HoldsWhatThePlainFvcHoldsAfterEverySeventhBlock) {
  patterns::on_every_target([] {
    for (const uint32_t entries : {2u, 4u, 16u, 64u, 128u}) {
      patterns::Dice dice(entries);
      const FvcConfig config{.entries = entries};
      Fvc plain(config, traits(PixelFormat::kRgba8));
      Collector fast(config, traits(PixelFormat::kRgba8));
      for (uint32_t block = 0; block < 4000; ++block) {
        if (block % 500 == 0) {
          plain.reset();
          fast.begin_frame();
        }
        constexpr uint32_t kColors[] = {1, 2, 5, 20, 70, 130, 300, 60000};
        const auto pixels = patterns::draw_block(kColors[dice.below(8)], 1 + dice.below(12), dice);
        plain.see_all(pixels.data(), kBlockPixels);
        show(fast, {pixels.begin(), pixels.end()});
        if (block % 7 != 0) continue;
        fast.end_frame();
        ASSERT_EQ(fvc_differences(plain, fast.fvc()), "") << entries << " entries, block " << block;
      }
    }
  });
}

TEST(Collector, HoldsWhatThePlainFvcHoldsWhereMissesMeetOnlyFrequentColours) {
  for (const FvcPolicy policy : {FvcPolicy::kLfc, FvcPolicy::k2Lfc})
    for (uint32_t seed = 1; seed <= 40; ++seed) {
      const FvcConfig config{.entries = 16u << seed % 3, .policy = policy};
      patterns::Dice dice(seed);
      Collector collector(config, traits(PixelFormat::kRgba8));
      Fvc plain(config, traits(PixelFormat::kRgba8));
      const auto see = [&](const std::vector<uint32_t>& pixels) {
        plain.see_all(pixels.data(), static_cast<uint32_t>(pixels.size()));
        show(collector, pixels);
      };
      for (uint32_t color = 0; color < config.entries; ++color)
        see(std::vector<uint32_t>(100 + dice.below(100), color));
      for (uint32_t block = 0; block < 60; ++block) {
        std::vector<uint32_t> pixels(kBlockPixels);
        for (uint32_t& pixel : pixels) pixel = 1000 + dice.below(dice.below(4) == 0 ? 3 : 50000);
        see(pixels);
        see({pixels[5], pixels[60]});
        collector.end_frame();
        ASSERT_EQ(fvc_differences(plain, collector.fvc()), "") << "seed " << seed << ", block " << block;
      }
    }
}
