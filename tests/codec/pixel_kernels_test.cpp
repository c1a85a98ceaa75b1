// Pixel kernels: every target returns what the plain kernel returns.
#include "pixels/pixel_kernels.h"

#include <algorithm>

#include "kernel_targets.h"

using namespace tilepress;
using patterns::draw_block;
using patterns::on_every_target;

namespace {
constexpr int kRounds = 1000;
constexpr const PixelKernels& kPlain = kPlainPixelKernels;
}  // namespace

TEST(PixelKernels, LoadTraversalIsTheSameOnEveryTarget) {
  patterns::Dice dice(1);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    constexpr uint32_t kStride = 11;
    uint32_t plane[8 * kStride];
    const uint32_t step = round % 3;  // one colour, a ramp, or one colour with one other pixel
    for (uint32_t i = 0; i < std::size(plane); ++i) plane[i] = step == 1 ? i : 7;
    if (step == 2) plane[dice.below(8) * kStride + dice.below(8)] ^= 1u << dice.below(32);
    uint32_t wanted[64];
    const bool uniform = kPlain.load_traversal(plane, kStride, wanted);
    EXPECT_EQ(uniform, step == 0);
    on_every_target([&] {
      uint32_t pixels[64];
      ASSERT_EQ(pixel_kernels().load_traversal(plane, kStride, pixels), uniform);
      ASSERT_TRUE(std::ranges::equal(pixels, wanted));
    });
  }
}

TEST(PixelKernels, SolidBlocksIsTheSameOnEveryTarget) {
  patterns::Dice dice(2);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    constexpr uint32_t kRow = 8 * 9;  // nine blocks side by side
    uint32_t row[8 * kRow];
    std::ranges::fill(row, dice.next());
    if (round % 4 != 0) row[dice.below(8 * kRow)] = dice.next();
    const uint32_t most = 1 + dice.below(9);
    const uint32_t wanted = kPlain.solid_blocks(row, kRow, row[0], most);
    on_every_target([&] { ASSERT_EQ(pixel_kernels().solid_blocks(row, kRow, row[0], most), wanted); });
  }
}

TEST(PixelKernels, ReadRawIsTheSameOnEveryTarget) {
  patterns::Dice dice(3);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    uint8_t bytes[256];
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(dice.next());
    on_every_target([&] {
      uint32_t raster[64];
      pixel_kernels().read_raw(bytes, raster);
      for (uint32_t i = 0; i < 64; ++i) {
        const uint8_t* at = bytes + 4 * i;
        ASSERT_EQ(raster[kTraversal[i]],
                  uint32_t{at[0]} << 24 | uint32_t{at[1]} << 16 | uint32_t{at[2]} << 8 | at[3]);
      }
    });
  }
}

TEST(PixelKernels, ReplaceRowIsTheSameOnEveryTarget) {
  patterns::Dice dice(4);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    std::array<uint32_t, 80> row, words;
    for (uint32_t i = 0; i < row.size(); ++i) {
      row[i] = dice.next() | 0xFF000000u;
      words[i] = dice.below(4) != 0 ? row[i] : dice.next();
    }
    std::array<std::byte, 321> bytes;
    const size_t offset = dice.below(2);  // of any alignment
    std::memcpy(bytes.data() + offset, words.data(), 320);
    const uint32_t count = 1 + dice.below(80), set_bits = round % 2 == 0 ? 0xFF000000u : 0;
    const bool swap = round % 3 == 0, note = round % 5 != 0;
    std::array<uint8_t, 10> changed_blocks{};
    std::array<uint32_t, 80> wanted = row;
    const uint32_t changed = kPlain.replace_row(bytes.data() + offset, count, swap, set_bits, wanted.data(),
                                                note ? changed_blocks.data() : nullptr);
    on_every_target([&] {
      std::array<uint8_t, 10> other_blocks{};
      std::array<uint32_t, 80> other = row;
      ASSERT_EQ(pixel_kernels().replace_row(bytes.data() + offset, count, swap, set_bits, other.data(),
                                            note ? other_blocks.data() : nullptr),
                changed);
      ASSERT_EQ(other, wanted);
      for (size_t i = 0; i < other_blocks.size(); ++i)
        ASSERT_EQ(other_blocks[i] != 0, changed_blocks[i] != 0);
    });
  }
}

TEST(PixelKernels, RunBeginsIsTheSameOnEveryTarget) {
  patterns::Dice dice(5);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const auto pixels = draw_block(1 + dice.below(12), 1 + dice.below(20), dice);
    const uint64_t wanted = kPlain.run_begins(pixels.data());
    on_every_target([&] { ASSERT_EQ(pixel_kernels().run_begins(pixels.data()), wanted); });
  }
}

TEST(PixelKernels, PlacesOfIsTheSameOnEveryTarget) {
  patterns::Dice dice(6);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const auto pixels = draw_block(1 + dice.below(12), 1 + dice.below(20), dice);
    const uint32_t color = round % 8 == 0 ? dice.next() : pixels[7];
    const uint64_t wanted = kPlain.places_of(pixels.data(), color);
    on_every_target([&] { ASSERT_EQ(pixel_kernels().places_of(pixels.data(), color), wanted); });
  }
}

TEST(PixelKernels, SplitIsTheSameOnEveryTarget) {
  patterns::Dice dice(7);
  uint32_t split = 0;
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const auto pixels = draw_block(1 + dice.below(12), 1 + dice.below(20), dice);
    FewColors few;
    const bool is_few = kPlain.split(pixels.data(), few);
    split += is_few;
    on_every_target([&] {
      FewColors other;
      ASSERT_EQ(pixel_kernels().split(pixels.data(), other), is_few);
      if (!is_few) return;
      ASSERT_EQ(few.count, other.count);
      ASSERT_TRUE(std::equal(few.colors, few.colors + few.count, other.colors));
      ASSERT_TRUE(std::equal(few.places, few.places + few.count, other.places));
    });
  }
  EXPECT_GT(split, 100u);
}
