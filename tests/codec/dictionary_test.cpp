// CCD, rCCD, Algorithm 1 and Huffman codes: the paper's worked figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "dcp/ccd.h"
#include "dcp/fvc.h"
#include "dictionary/color_table.h"
#include "dictionary/huffman.h"
#include "tilepress/algorithm1.h"

using namespace tilepress;

namespace {

using Counts = std::vector<uint32_t>;

double bits_per_pixel(const Counts& counts, const std::vector<uint8_t>& lengths) {
  double bits = 0, pixels = 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    bits += double(counts[i]) * lengths[i];
    pixels += counts[i];
  }
  return bits / pixels;
}

}  // namespace

TEST(Ccd, OrdersByCountThenBySlot) {
  FvcConfig config;
  config.entries = 8;
  Fvc fvc(config, traits(PixelFormat::kRgba8));
  for (const uint32_t color : {10, 20, 30, 40, 30, 20, 40, 40}) fvc.see_run(color, 1);  // 10:1 20:2 30:2 40:3
  Ccd ccd;
  ccd.build(fvc);
  EXPECT_EQ(ccd.entries, 8u);
  EXPECT_EQ(ccd.index_bits(), 3u);
  EXPECT_EQ(ccd.colors, (std::vector<uint32_t>{40, 20, 30, 10}));
  EXPECT_EQ(ccd.counts, (Counts{3, 2, 2, 1}));
}

TEST(ColorTable, ReadsBackWhatItWrote) {
  const std::vector<uint32_t> colors = {0xFFFFFFFF, 0, 7};
  std::vector<uint8_t> bytes(17);
  BitWriter writer(bytes);
  write_colors(colors, 4, 32, writer);
  EXPECT_EQ(writer.bit_count(), 4 * 33u);
  writer.flush();
  BitReader reader(bytes, writer.bit_count());
  ColorTable table;
  ASSERT_TRUE(table.read(reader, 4, 32));
  EXPECT_EQ(table.colors(), colors);
  EXPECT_EQ(table.slots(), 4u);
}

TEST(ColorTable, RefusesSlotCountsAndGapsThatNoEncoderWrites) {
  std::vector<uint8_t> bytes(9000, 0);
  ColorTable table;
  for (const uint64_t slots : {0, 3, 2048}) {
    BitReader reader(bytes);
    EXPECT_FALSE(table.read(reader, slots, 32)) << slots;
  }
  bytes[33 / 8] = 0x40;  // slot 0 invalid, slot 1 (bit 33) valid
  BitReader gap(bytes);
  EXPECT_FALSE(table.read(gap, 2, 32));
  BitReader truncated(std::span<const uint8_t>(bytes).first(4));
  EXPECT_FALSE(table.read(truncated, 1, 32));
}

TEST(Algorithm1, PrefersTwoEntriesInThePapersExample) {
  // 80 % white, 18 % blue, 1 % black, 1 % red. Two entries: 98·1 + 2·32 = 162 bits for 100 pixels, 3200/162 =
  // 19.75; four entries: 200 bits, 16:1.
  const Counts counts = {80, 18, 1, 1};
  EXPECT_EQ(optimal_width(counts, 100, 6, 32), 1u);
  EXPECT_NEAR(3200.0 / (98 * 1 + 2 * 32), 19.75, 0.005);
  EXPECT_EQ(3200.0 / (100 * 2), 16.0);
}

TEST(Algorithm1, ReachesTheLargestDictionary) {
  // 64 colours, once each: 64·6 = 384 bits, every smaller dictionary leaves half or more of the pixels raw.
  EXPECT_EQ(optimal_width(Counts(64, 1), 64, 6, 32), 6u);
}

TEST(Algorithm1, ReturnsZeroWhenNothingHelps) {
  EXPECT_EQ(optimal_width(Counts{}, 0, 6, 32), 0u);
  EXPECT_EQ(optimal_width(Counts{100}, 100, 6, 32), 0u);  // one colour: index 0 needs no bits
}

TEST(Algorithm1, KeepsTheSmallerDictionaryOnATie) {
  // 31 of 32 pixels in entry 0: i = 0 costs 0·31 + 1·32 = 32 bits, i = 1 costs 32·1 = 32 bits.
  EXPECT_EQ(optimal_width(Counts{31, 1}, 32, 6, 32), 0u);
  // One pixel more in entry 1 (33 pixels): i = 0 costs 64, i = 1 costs 33.
  EXPECT_EQ(optimal_width(Counts{31, 2}, 33, 6, 32), 1u);
}

TEST(Huffman, GivesThePapersRateOf21Where1BitIndicesGive24) {
  // A 49.5 %, B 49.5 %, C 0.5 %, D 0.5 %: codes of 1, 2, 3, 3 bits, 1.515 bits a pixel, 32/1.515 = 21.12.
  const Counts counts = {495, 495, 5, 5};
  const auto lengths = huffman_lengths(counts);
  std::vector<uint8_t> sorted = lengths;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted, (std::vector<uint8_t>{1, 2, 3, 3}));
  EXPECT_NEAR(32 / bits_per_pixel(counts, lengths), 21.12, 0.005);
  // A and B in one bit, C and D raw: 0.99·1 + 0.01·32 = 1.31 bits a pixel.
  EXPECT_EQ(optimal_width(counts, 1000, 6, 32), 1u);
  EXPECT_NEAR(32 / (0.99 * 1 + 0.01 * 32), 24.4, 0.05);
}

TEST(Huffman, GivesOneColourOneBit) {
  EXPECT_EQ(huffman_lengths(Counts{7}), (std::vector<uint8_t>{1}));
}

TEST(Huffman, BreaksTiesByTheLowerId) {
  // 2,1,1: ids 1 and 2 join to id 3 of count 2; then (2, id 0) and (2, id 3).
  EXPECT_EQ(huffman_lengths(Counts{2, 1, 1}), (std::vector<uint8_t>{1, 2, 2}));
  // 1,1,1: ids 0 and 1 are the smallest; the third leaf stays near the root.
  EXPECT_EQ(huffman_lengths(Counts{1, 1, 1}), (std::vector<uint8_t>{2, 2, 1}));
  // 2,2,1,1,1: 2+3 → 5 (2); then (1, id 4) with (2, id 0) → 6 (3); (2, id 1) with (2, id 5) → 7 (4); 6+7.
  EXPECT_EQ(huffman_lengths(Counts{2, 2, 1, 1, 1}), (std::vector<uint8_t>{2, 2, 3, 3, 2}));
}

TEST(Huffman, DeepestTreeStaysWithinTheStoredLength) {
  Counts fibonacci = {1, 1};
  while (fibonacci.size() < 45) fibonacci.push_back(fibonacci.end()[-1] + fibonacci.end()[-2]);
  std::reverse(fibonacci.begin(), fibonacci.end());
  const auto lengths = huffman_lengths(fibonacci);
  EXPECT_EQ(*std::max_element(lengths.begin(), lengths.end()), 44);
  CanonicalCode code;
  EXPECT_TRUE(code.assign(lengths));
}

TEST(Huffman, CanonicalCodesReadBackEverySymbol) {
  const std::vector<uint8_t> lengths = {2, 1, 3, 3};  // 10, 0, 110, 111
  CanonicalCode code;
  ASSERT_TRUE(code.assign(lengths));
  EXPECT_EQ(code.code(0), 0b10u);
  EXPECT_EQ(code.code(1), 0b0u);
  EXPECT_EQ(code.code(2), 0b110u);
  EXPECT_EQ(code.code(3), 0b111u);
  for (uint32_t symbol = 0; symbol < 4; ++symbol) {
    std::vector<uint8_t> bytes(1);
    BitWriter writer(bytes);
    writer.put(code.code(symbol), code.length(symbol));
    writer.flush();
    BitReader reader(bytes);
    uint32_t read = 99;
    ASSERT_TRUE(code.read(reader, read));
    EXPECT_EQ(read, symbol);
    EXPECT_EQ(reader.position(), code.length(symbol));
  }
}

TEST(Huffman, CodesOfEveryLengthReadBackOneByOneAndInFours) {
  // 1, 2, 3 … 44, 44 bits: below and above what the table of the reader holds, up to 176 bits for four.
  Counts fibonacci = {1, 1};
  while (fibonacci.size() < 45) fibonacci.push_back(fibonacci.end()[-1] + fibonacci.end()[-2]);
  std::reverse(fibonacci.begin(), fibonacci.end());
  CanonicalCode code;
  ASSERT_TRUE(code.assign(huffman_lengths(fibonacci)));
  std::mt19937 random(5);
  for (uint32_t round = 0; round < 5000; ++round) {
    uint32_t symbols[4], bits = round % 8;
    for (uint32_t& symbol : symbols) symbol = random() % (round % 2 != 0 ? 45u : 12u);
    std::vector<uint8_t> bytes(32);
    BitWriter writer(bytes);
    writer.put(0, bits);
    for (const uint32_t symbol : symbols) {
      writer.put(code.code(symbol), code.length(symbol));
      bits += code.length(symbol);
    }
    writer.flush();
    BitReader one(bytes), four(bytes);
    one.skip(round % 8);
    four.skip(round % 8);
    uint32_t read[4];
    ASSERT_TRUE(code.read_four(four, read));
    EXPECT_TRUE(std::ranges::equal(read, symbols));
    EXPECT_EQ(four.position(), bits);
    for (const uint32_t symbol : symbols) {
      ASSERT_TRUE(code.read(one, read[0]));
      EXPECT_EQ(read[0], symbol);
    }
    EXPECT_EQ(one.position(), bits);
  }
}

TEST(Huffman, BitsThatNoCodeBeginsWithAreNotRead) {
  CanonicalCode code;
  ASSERT_TRUE(code.assign(std::vector<uint8_t>{1, 12}));  // 0 and 1000 0000 0000
  const std::vector<uint8_t> bytes = {0x3F, 0xFF};        // 0, 0, then ones
  uint32_t read[4];
  BitReader four(bytes), one(bytes);
  EXPECT_FALSE(code.read_four(four, read));
  one.skip(2);
  EXPECT_FALSE(code.read(one, read[0]));
  EXPECT_EQ(one.position(), 2u);
}

TEST(Huffman, RefusesLengthsThatAreNoPrefixCode) {
  CanonicalCode code;
  EXPECT_FALSE(code.assign(std::vector<uint8_t>{1, 1, 1}));
  EXPECT_FALSE(code.assign(std::vector<uint8_t>{0}));
  EXPECT_FALSE(code.assign(std::vector<uint8_t>{48}));
}
