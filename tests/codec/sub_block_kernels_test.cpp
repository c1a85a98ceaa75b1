// Sub-block kernels: where a target has one, it returns what the plain code returns.
#include "dcp/sub_block_kernels.h"

#include <algorithm>

#include "dcp/sub_blocks.h"
#include "dictionary/huffman_blocks.h"
#include "kernel_targets.h"

using namespace tilepress;
using patterns::draw_block;
using patterns::on_every_target;

namespace {

constexpr int kRounds = 3000;

/// A block with `raw_share` quarters of its sub-blocks raw and index widths below `widths`.
struct DrawnBlock {
  patterns::BlockPixels pixels;
  uint16_t indices[64];
  uint8_t widths[16];

  DrawnBlock(uint32_t raw_share, uint32_t most_widths, patterns::Dice& dice)
      : pixels(draw_block(1 + dice.below(60), 1 + dice.below(20), dice)) {
    for (uint32_t sub = 0; sub < 16; ++sub) {
      widths[sub] = dice.below(4) < raw_share ? kRawWidth : static_cast<uint8_t>(dice.below(most_widths));
      for (uint32_t i = 4 * sub; i < 4 * sub + 4; ++i)
        indices[i] =
            widths[sub] == kRawWidth ? kNotInCcd : static_cast<uint16_t>(dice.below(1u << widths[sub]));
    }
  }
};

/// The payload as defined, in a buffer of 256 bytes of zeros.
uint32_t write_plainly(const DrawnBlock& block, uint8_t (&bytes)[256]) {
  std::ranges::fill(bytes, uint8_t{0});
  BitWriter out(bytes);
  write_payload_plainly({block.pixels.data(), block.indices, block.widths}, 32, out);
  out.flush();
  return static_cast<uint32_t>(out.bit_count());
}

/// The low `mark_bits` bits of the widths, eight to a word.
void pack_marks(const uint8_t* widths, uint32_t mark_bits, uint64_t (&marks)[2]) {
  marks[0] = marks[1] = 0;
  for (uint32_t sub = 0; sub < 16; ++sub)
    marks[sub / 8] = marks[sub / 8] << mark_bits | (widths[sub] & ((1u << mark_bits) - 1));
}

/// What SubBlockKernels::read is for, index by index.
uint32_t read_plainly(const uint8_t* bytes, const uint64_t marks[2], uint32_t mark_bits, uint32_t most_bits,
                      const uint32_t* colors, uint32_t known, uint32_t* raster) {
  BitReader bits({bytes, 64});
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const uint32_t sub = i / kSubBlockPixels;
    const uint64_t width = marks[sub / 8] >> (7 - sub % 8) * mark_bits & ((1u << mark_bits) - 1);
    const uint64_t index = width <= most_bits ? bits.get(static_cast<uint32_t>(width)) : known;
    if (index >= known) return kNotAllIndices;
    raster[kTraversal[i]] = colors[index];
  }
  return static_cast<uint32_t>(bits.position());
}

}  // namespace

TEST(SubBlockKernels, WriteIsThePlainPayloadOnEveryTarget) {
  patterns::Dice dice(1);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const DrawnBlock block(dice.below(5), 8, dice);
    const uint32_t mark_bits = 3 + dice.below(5);
    uint8_t wanted[256];
    const uint32_t bits = write_plainly(block, wanted);
    uint64_t marks[2];
    pack_marks(block.widths, mark_bits, marks);
    ASSERT_EQ(bits, payload_bits(block.widths, 32));
    on_every_target([&] {
      const auto write = sub_block_kernels().write;
      if (write == nullptr) return;
      uint8_t bytes[256];
      std::ranges::fill(bytes, uint8_t{0xBB});
      const WrittenBlock written = write(block.pixels.data(), block.indices, block.widths, mark_bits, bytes);
      ASSERT_EQ(written.bits, bits);
      ASSERT_EQ(written.clean_bytes, std::min(256u, (bits / 512 + 1) * 64));
      ASSERT_TRUE(std::ranges::equal(written.marks, marks));
      ASSERT_TRUE(std::equal(wanted, wanted + written.clean_bytes, bytes));
    });
  }
}

TEST(SubBlockKernels, ReadIsIndexByIndexOnEveryTarget) {
  patterns::Dice dice(2);
  uint32_t all_indices = 0;
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    const DrawnBlock block(0, 3 + dice.below(5), dice);
    const uint32_t mark_bits = 3 + dice.below(5);
    uint8_t bytes[256];
    const uint32_t bits = write_plainly(block, bytes);
    uint64_t marks[2];
    pack_marks(block.widths, mark_bits, marks);
    if (round % 3 == 0) marks[0] = uint64_t{dice.next()} << 32 | dice.next();  // hostile
    const uint32_t most_bits = round % 2 == 0 ? 6 : 1 + dice.below(7);
    const uint32_t known = round % 5 != 0 ? 64 : dice.below(65);
    uint32_t wanted[64];
    const uint32_t read =
        read_plainly(bytes, marks, mark_bits, most_bits, block.pixels.data(), known, wanted);
    if (round % 3 != 0 && read != kNotAllIndices) {
      ++all_indices;
      ASSERT_EQ(read, bits);
      for (uint32_t i = 0; i < 64; ++i) ASSERT_EQ(wanted[kTraversal[i]], block.pixels[block.indices[i]]);
    }
    on_every_target([&] {
      if (sub_block_kernels().read == nullptr) return;
      uint32_t raster[64];
      ASSERT_EQ(
          sub_block_kernels().read(bytes, marks, mark_bits, most_bits, block.pixels.data(), known, raster),
          read);
      ASSERT_TRUE(read == kNotAllIndices || std::ranges::equal(raster, wanted));
    });
  }
  EXPECT_GT(all_indices, 500u);
}

TEST(HuffmanBlocks, CodeSumAddsTheLengthsOnEveryTarget) {
  patterns::Dice dice(3);
  for (int round = 0; round < kRounds && !HasFatalFailure(); ++round) {
    uint8_t lengths[64];
    for (uint8_t& length : lengths) length = static_cast<uint8_t>(1 + dice.below(63));
    uint16_t indices[64];
    const uint32_t raw_share = dice.below(5), raw_bits = 64u << round % 2;
    for (uint16_t& index : indices)
      index = dice.below(8) < raw_share ? kNotInCcd : static_cast<uint16_t>(dice.below(64));
    uint32_t wanted = 0;
    for (uint32_t sub = 0; sub < 16; ++sub) {
      uint32_t bits = 0;
      for (uint32_t i = 4 * sub; i < 4 * sub + 4; ++i)
        bits += indices[i] == kNotInCcd ? raw_bits : lengths[indices[i]];
      wanted += std::min(bits, raw_bits);
    }
    on_every_target([&] {
      if (code_sum_kernel() != nullptr) {
        ASSERT_EQ(code_sum_kernel()(indices, lengths, raw_bits), wanted);
      }
    });
  }
}

TEST(SubBlocks, OfAWidthUpToALimitAreCountedWithoutRawOnes) {
  patterns::Dice dice(4);
  for (int round = 0; round < kRounds; ++round) {
    const DrawnBlock block(dice.below(5), 11, dice);
    const uint32_t limit = dice.below(11);
    ASSERT_EQ(count_up_to(block.widths, limit),
              static_cast<uint32_t>(
                  std::ranges::count_if(block.widths, [&](uint32_t width) { return width <= limit; })));
  }
}
