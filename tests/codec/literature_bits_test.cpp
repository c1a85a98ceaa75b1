// Bitstreams of FPC, FPC-D, C-Pack, FreqVals, HiLo and MSAA, field by field.
#include <gtest/gtest.h>

#include "block_harness.h"

using namespace harness;

namespace {

/// A bit field: its value and its bits.
struct Field {
  uint64_t value;
  uint32_t bits;
};

/// A block whose four 64-byte lines are the same, or that repeats fewer pixels.
Block repeated(const std::vector<uint32_t>& words) {
  Block block;
  for (uint32_t i = 0; i < kBlockPixels; ++i) block.pixels[i] = words[i % words.size()];
  return block;
}

/// The block whose pixel at traversal position i is color_of(i).
template <class ColorOf>
Block traversed(const ColorOf& color_of) {
  Block block;
  for (uint32_t i = 0; i < kBlockPixels; ++i) block.pixels[kTraversal[i]] = color_of(i);
  return block;
}

void expect_fields(const Encoded& bits, const std::vector<Field>& fields) {
  BitReader in = bits.read_payload();
  for (size_t i = 0; i < fields.size(); ++i)
    EXPECT_EQ(in.get(fields[i].bits), fields[i].value) << "field " << i;
}

/// One scheme's size of a block, after a round trip.
uint32_t size_of(const char* scheme, const Block& block) {
  const BlockHarness harness(scheme, nullptr);
  EXPECT_TRUE(harness.returns(block)) << scheme;
  return harness.measure(block);
}

}  // namespace

TEST(Fpc, TakesEachOfItsForms) {
  const std::vector<uint32_t> words = {7,          0xFFFFFFF8, 8,          0xFFFFFF80, 0x7FFF, 0xFFFF8000,
                                       0x12340000, 0xFF80007F, 0x42424242, 0x12345678, 0,      0,
                                       1,          0,          0,          0};
  // Behind prefixes of 3 bits: 4, 4, 8, 8, 16, 16, 16, 16, 8 and 32 bits; two zeros: 3; 4; three zeros: 3.
  const uint32_t bits = 7 + 7 + 11 + 11 + 4 * 19 + 11 + 35 + 6 + 7 + 6;
  EXPECT_EQ(bits, 177u);
  const BlockHarness fpc("fpc", nullptr);
  const Encoded encoded = fpc.encode(repeated(words));
  expect_fields(encoded,
                {{1, 3}, {7, 4},       {1, 3}, {8, 4},           {2, 3}, {8, 8},       {2, 3}, {0x80, 8},
                 {3, 3}, {0x7FFF, 16}, {3, 3}, {0x8000, 16},     {4, 3}, {0x1234, 16}, {5, 3}, {0x807F, 16},
                 {6, 3}, {0x42, 8},    {7, 3}, {0x12345678, 32}, {0, 3}, {1, 3},       {1, 3}, {1, 4},
                 {0, 3}, {2, 3}});
  EXPECT_EQ(encoded.read_csb().get(7), 23u);  // 177 bits are 23 bytes
  EXPECT_EQ(size_of("fpc", repeated(words)), 4u * 8 * 23);
  EXPECT_EQ(fpc.encoder().csb_bits(), 28u);
}

TEST(Fpc, RunsOfZerosHaveUpToEightWords) {
  EXPECT_EQ(size_of("fpc", solid(0)), 4u * 16);  // two runs: 12 bits, 2 bytes
  std::vector<uint32_t> nine(16, 1);  // nine zeros: two runs, and 7 ones: 12 + 7 · 7 bits, 8 bytes
  std::fill(nine.begin() + 3, nine.begin() + 12, 0);
  EXPECT_EQ(size_of("fpc", repeated(nine)), 4u * 64);
  nine[11] = 1;  // eight zeros: one run, 6 + 8 · 7 bits, 8 bytes
  EXPECT_EQ(size_of("fpc", repeated(nine)), 4u * 64);
  nine[10] = 1;  // 6 + 9 · 7 bits: 9 bytes
  EXPECT_EQ(size_of("fpc", repeated(nine)), 4u * 72);
}

TEST(Fpc, ALineOf64BytesIsRaw) {
  std::vector<uint32_t> words(16, 0x12345678);  // 14 raw words and two of 4 bits: 504 bits, 63 bytes
  words[14] = words[15] = 1;
  EXPECT_EQ(size_of("fpc", repeated(words)), 4u * 504);
  words[15] = 8;  // 508 bits, 64 bytes
  const BlockHarness fpc("fpc", nullptr);
  EXPECT_EQ(size_of("fpc", repeated(words)), 2048u);
  EXPECT_EQ(fpc.encode(repeated(words)).read_csb().get(7), 0u);
}

TEST(Fpcd, TakesEachOfItsForms) {
  const std::vector<uint32_t> words = {0,          ~0u,        0xAB,       0xAB000000, 0x22222222, 0x2222227F,
                                       0x1234,     0x00560078, 0xFFFF1234, 0x56780000, 0x5678ABCD, 0x5678ABCD,
                                       0x13572468, 0x5678ABCE, 0x13572468, 0x56781111};
  const Encoded encoded = BlockHarness("fpcd", nullptr).encode(repeated(words));
  expect_fields(encoded, {{0, 4},    {1, 4},       {4, 4},  {0xAB, 8},    {5, 4},           {0xAB, 8},
                          {6, 4},    {0x22, 8},    {7, 4},  {0x7F, 8},    {9, 4},           {0x1234, 16},
                          {10, 4},   {0x5678, 16}, {11, 4}, {0x1234, 16}, {12, 4},          {0x5678, 16},
                          {13, 4},   {0xABCD, 16}, {2, 4},  {15, 4},      {0x13572468, 32}, {8, 4},
                          {0xCE, 8}, {3, 4},       {14, 4}, {0x1111, 16}});
  // Behind 16 prefixes: five words of 1 byte, six of 2, one of 4: 64 + 40 + 96 + 32 bits.
  EXPECT_EQ(encoded.read_csb().get(7), 29u);
  EXPECT_EQ(size_of("fpcd", repeated(words)), 4u * 232);
}

TEST(Fpcd, EachLineForgetsTheOneBefore) {
  EXPECT_EQ(size_of("fpcd", solid(0x12345678)), 4u * 96);  // 36 + 15 · 4 bits
  EXPECT_EQ(size_of("fpcd", solid(0)), 4u * 64);
}

TEST(Cpack, TakesEachOfItsCodes) {
  const std::vector<uint32_t> words = {0,    0x12345678, 0x12345678, 0x123456FF, 0x1234ABCD, 0x7F,
                                       0x7F, 0x100,      0x1AA,      0x123456FE, 0x123456FF, 0,
                                       0,    0,          0,          0};
  const Encoded encoded = BlockHarness("cpack", nullptr).encode(repeated(words));
  expect_fields(
      encoded, {{0, 2},    {1, 2},      {0x12345678, 32}, {2, 2},       {0, 4},      {0b1110, 4}, {0, 4},
                {0xFF, 8}, {0b1100, 4}, {0, 4},           {0xABCD, 16}, {0b1101, 4}, {0x7F, 8},   {0b1101, 4},
                {0x7F, 8}, {1, 2},      {0x100, 32},      {0b1110, 4},  {3, 4},      {0xAA, 8},   {0b1110, 4},
                {0, 4},    {0xFE, 8},   {2, 2},           {1, 4},       {0, 10}});
  const uint32_t bits = 2 + 34 + 6 + 16 + 24 + 12 + 12 + 34 + 16 + 16 + 6 + 5 * 2;
  EXPECT_EQ(bits, 188u);
  EXPECT_EQ(encoded.read_csb().get(7), 24u);
  EXPECT_EQ(size_of("cpack", repeated(words)), 4u * 192);
  EXPECT_EQ(size_of("cpack", solid(0x12345678)), 4u * 128);  // 34 + 15 · 6 = 124 bits
}

TEST(FreqVals, HasAnEscapeEvenWhereNoPixelNeedsIt) {
  // Counts 6, 5, 4 and an escape of weight 0: C and the escape join first, then B, then A.
  const uint32_t a = 0xFF000001, b = 0xFF000002, c = 0xFF000003, other = 0x87654321;
  const Ccd ccd = dictionary(4, {a, b, c});
  const BlockHarness scheme("freqvals:fvc=4", &ccd);
  EXPECT_TRUE(scheme.tables_accepted());
  EXPECT_EQ(scheme.tables_written(), 4u * 39 + 6);
  EXPECT_EQ(scheme.measure(solid(a)), 64u);
  EXPECT_EQ(scheme.measure(solid(b)), 128u);
  EXPECT_EQ(scheme.measure(solid(c)), 192u);
  EXPECT_EQ(scheme.encode(solid(b)).read_csb().get(5), 1u);
  Block block = solid(a);
  block.pixels[0] = other;
  block.pixels[1] = c;
  expect_fields(scheme.encode(block), {{0b111, 3}, {other, 32}, {0b110, 3}, {0, 1}});
  EXPECT_TRUE(scheme.returns(block));
}

TEST(FreqVals, ABlockOf2048BitsIsRaw) {
  const uint32_t a = 0xFF000001;
  const Ccd ccd = dictionary(2, {a});
  const BlockHarness scheme("freqvals:fvc=2", &ccd);
  for (const uint32_t others : {62u, 63u}) {  // 64 codes of a bit, and 32 bits for each other pixel
    Block block = solid(0x12345678);
    for (uint32_t i = others; i < kBlockPixels; ++i) block.pixels[i] = a;
    EXPECT_EQ(scheme.measure(block), 2048u);
    EXPECT_EQ(scheme.encode(block).read_csb().get(5), 0u);
    EXPECT_TRUE(scheme.returns(block));
  }
  Block block = solid(0x12345678);
  for (uint32_t i = 61; i < kBlockPixels; ++i) block.pixels[i] = a;
  EXPECT_EQ(scheme.measure(block), 64u + 61 * 32);  // as many bursts as a raw block, yet not raw
  EXPECT_EQ(scheme.encode(block).read_csb().get(5), 16u);
  EXPECT_TRUE(scheme.returns(block));
}

TEST(FreqVals, IsRawWithoutATable) {
  const BlockHarness scheme("freqvals", nullptr);
  EXPECT_EQ(scheme.tables_written(), 0u);
  EXPECT_EQ(scheme.measure(solid(1)), 2048u);
  EXPECT_EQ(scheme.encoder().csb_bits(), 5u);
  EXPECT_TRUE(scheme.returns(solid(1)));
}

TEST(Hilo, TakesEachOfItsClasses) {
  const auto steps = [](uint32_t base, uint32_t count, uint32_t step) {
    return traversed([=](uint32_t i) { return base + i % count * step; });
  };
  EXPECT_EQ(size_of("hilo", solid(0xFF123456)), 512u);
  EXPECT_EQ(size_of("hilo", steps(0xFF000000, 4, 32)), 512u);  // high parts 0 … 3: least, +1, −1, greatest
  EXPECT_EQ(size_of("hilo", steps(0xFF000000, 5, 32)), 1024u);
  EXPECT_EQ(size_of("hilo", steps(0xFF000000, 5, 1u << 13)), 1536u);
  EXPECT_EQ(size_of("hilo", steps(0x10000000, 5, 1u << 21)), 2048u);
  EXPECT_EQ(size_of("hilo", steps(0, 2, ~0u)), 512u);
  const BlockHarness hilo("hilo", nullptr);
  EXPECT_EQ(hilo.encoder().csb_bits(), 2u);
  const Encoded bits = hilo.encode(steps(0xFF000001, 4, 32));
  EXPECT_EQ(bits.read_csb().get(2), 0u);
  expect_fields(bits,
                {{0x7F80000, 27}, {0x7F80003, 27}, {0, 2}, {1, 5}, {2, 2}, {1, 5}, {3, 2}, {1, 5}, {1, 2}});
}

TEST(Msaa, TakesEachOfItsLevels) {
  const BlockHarness msaa("msaa", nullptr);
  const auto level_of = [&](const Block& block, uint32_t bits) {
    EXPECT_EQ(size_of("msaa", block), bits);
    return msaa.encode(block).read_csb().get(3);
  };
  EXPECT_EQ(msaa.encoder().csb_bits(), 3u);
  EXPECT_EQ(level_of(solid(5), 512), 0u);
  EXPECT_EQ(level_of(traversed([](uint32_t i) { return i / 4; }), 512), 0u);
  EXPECT_EQ(level_of(traversed([](uint32_t i) { return i / 16 * 2 + i % 2; }), 512), 1u);
  EXPECT_EQ(level_of(traversed([](uint32_t i) { return i / 2; }), 1024), 2u);
  EXPECT_EQ(level_of(traversed([](uint32_t i) { return i / 8 * 2 + i % 2; }), 1024), 3u);
  EXPECT_EQ(level_of(traversed([](uint32_t i) { return i / 4 * 2 + i % 2; }), 1536), 4u);
  EXPECT_EQ(level_of(traversed([](uint32_t i) { return i; }), 2048), 5u);
  EXPECT_EQ(level_of(traversed([](uint32_t i) { return i < 2 ? i : i == 2 ? 7u : 0u; }), 2048), 5u);
  expect_fields(msaa.encode(traversed([](uint32_t i) { return i / 16 * 2 + i % 2; })),
                {{0, 32}, {1, 32}, {0x5555, 16}, {2, 32}, {3, 32}});
}
