// Bitstreams of the DCP family: CSB marks, index widths, tables.
#include <gtest/gtest.h>

#include "block_harness.h"

using namespace harness;

namespace {

/// n different colours: 0x01000001, 0x01000002 …
std::vector<uint32_t> colors(uint32_t n) {
  std::vector<uint32_t> result;
  for (uint32_t i = 0; i < n; ++i) result.push_back(0x01000001 + i);
  return result;
}

/// A block that holds `color` everywhere but for sub-block 0, which holds a, b, c, d.
Block with_first_sub_block(uint32_t color, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
  Block block = solid(color);
  block.pixels[0] = a;
  block.pixels[1] = b;
  block.pixels[8] = c;
  block.pixels[9] = d;
  return block;
}

}  // namespace

TEST(DcpBits, WithoutADictionaryEverySubBlockIsRaw) {
  for (const char* name : {"dcp", "adcp", "vdcp", "huffdcp"}) {
    const BlockHarness scheme(name, nullptr);
    EXPECT_EQ(scheme.measure(solid(7)), 2048u) << name;
    EXPECT_EQ(scheme.encoder().palette_bits(), 0u) << name;
    EXPECT_TRUE(scheme.returns(solid(7))) << name;
  }
}

TEST(DcpBits, DcpWritesSixBitIndicesAndMarksWhatItCompressed) {
  const Ccd ccd = dictionary(64, colors(64));
  const BlockHarness scheme("dcp", &ccd);
  const Block block = with_first_sub_block(ccd.colors[63], 1, ccd.colors[0], ccd.colors[0], ccd.colors[0]);
  EXPECT_EQ(scheme.measure(block), 128u + 15 * 4 * 6);  // one pixel is not in the CCD: that sub-block is raw
  const Encoded bits = scheme.encode(block);
  EXPECT_EQ(bits.csb[0], 0x7F);
  EXPECT_EQ(bits.csb[1], 0xFF);
  BitReader payload = bits.read_payload();
  EXPECT_EQ(payload.get(32), 1u);
  payload.skip(96);
  EXPECT_EQ(payload.get(6), 63u);
  EXPECT_TRUE(scheme.returns(block));
  EXPECT_EQ(scheme.tables_written(), 64u * 33);  // the paper's 264 bytes
  EXPECT_EQ(scheme.tables_written() / 8, 264u);
}

TEST(DcpBits, AdcpCutsTheDictionaryToWhatAlgorithm1Chooses) {
  Ccd ccd = dictionary(64, {10, 20, 30, 40});
  ccd.counts = {80, 18, 1, 1};
  ccd.samples = 100;
  const BlockHarness scheme("adcp", &ccd);
  EXPECT_EQ(scheme.tables_written(), 2u * 33);
  // 15 sub-blocks in one bit a pixel; colour 30 is beyond the cut.
  EXPECT_EQ(scheme.measure(with_first_sub_block(10, 30, 10, 10, 10)), 128u + 15 * 4);
  EXPECT_TRUE(scheme.returns(with_first_sub_block(10, 30, 10, 20, 10)));
}

TEST(DcpBits, VdcpUsesTheBitWidthOfTheLargestIndex) {
  // The paper's example: {C2,C3} takes 2 bits a pixel, {C0,C1} one, {C0} alone none; the raw mark is all
  // ones. A dictionary of eight: M = 3, CSB of ceil(log2(5)) = 3 bits. The four further sub-blocks cover the
  // rest.
  const Ccd ccd = dictionary(8, colors(8));
  const auto& c = ccd.colors;
  const BlockHarness scheme("vdcp:fvc=8", &ccd);
  struct Row {
    uint32_t pixels[4];
    uint32_t csb, payload_bits;
  };
  const Row rows[] = {{{c[2], c[3], c[2], c[3]}, 0b010, 8}, {{c[0], c[1], c[0], c[1]}, 0b001, 4},
                      {{c[0], c[0], c[0], c[0]}, 0b000, 0}, {{c[4], c[7], c[0], c[1]}, 0b011, 12},
                      {{c[1], c[1], c[1], c[1]}, 0b001, 4}, {{c[0], c[2], c[0], c[0]}, 0b010, 8},
                      {{c[0], c[0], 99, c[0]}, 0b111, 128}};
  for (const Row& row : rows) {
    const Block block =
        with_first_sub_block(c[0], row.pixels[0], row.pixels[1], row.pixels[2], row.pixels[3]);
    EXPECT_EQ(scheme.measure(block), row.payload_bits);
    const Encoded bits = scheme.encode(block);
    EXPECT_EQ(bits.read_csb().get(3), row.csb);
    EXPECT_TRUE(scheme.returns(block));
  }
  const Encoded bits = scheme.encode(with_first_sub_block(c[0], c[2], c[3], c[3], c[2]));
  EXPECT_EQ(bits.read_payload().get(8), 0b10111110u);
}

TEST(DcpBits, VdcpCsbHoldsEveryWidthAndTheRawMark) {
  // ceil(log2(M + 2)) per sub-block: the paper's 3 bits for 64 entries.
  const uint32_t expected[] = {2, 2, 3, 3, 3, 3, 4, 4, 4, 4};  // N = 2, 4 … 1024
  for (uint32_t m = 1; m <= 10; ++m) {
    const Ccd ccd = dictionary(1u << m, colors(1u << m));
    const BlockHarness scheme("vdcp:fvc=" + std::to_string(1u << m), &ccd);
    EXPECT_EQ(scheme.encoder().csb_bits(), 16 * expected[m - 1]) << "N = " << (1u << m);
    EXPECT_EQ(scheme.measure(solid(ccd.colors.back())), 64 * m);
    EXPECT_TRUE(scheme.returns(solid(ccd.colors.back())));
    EXPECT_TRUE(scheme.returns(solid(99)));
  }
}

TEST(DcpBits, HuffdcpWritesCodesAndTheirLengthsInTheTable) {
  Ccd ccd = dictionary(4, {10, 20, 30, 40});
  ccd.counts = {495, 495, 5, 5};
  const BlockHarness scheme("huffdcp:fvc=4", &ccd);
  EXPECT_EQ(scheme.tables_written(), 4u * 39);
  // Joining (10: C, D) with A makes B the one-bit code.
  EXPECT_EQ(scheme.measure(solid(20)), 64u);
  EXPECT_EQ(scheme.measure(solid(10)), 128u);
  EXPECT_EQ(scheme.measure(solid(40)), 192u);
  EXPECT_TRUE(scheme.returns(with_first_sub_block(20, 10, 30, 40, 20)));
  EXPECT_TRUE(scheme.returns(with_first_sub_block(20, 10, 30, 41, 20)));
}

TEST(DcpBits, HuffdcpLeavesASubBlockRawWhenItsCodesAreNotShorter) {
  // Fibonacci counts make a chain: entry i has a code of i + 1 bits, the last two of 33.
  Ccd ccd = dictionary(64, colors(34));
  uint64_t a = 1, b = 1;
  for (size_t i = 34; i-- > 0;) {
    ccd.counts[i] = static_cast<uint32_t>(a);
    const uint64_t next = a + b;
    a = b;
    b = next;
  }
  const BlockHarness scheme("huffdcp", &ccd);
  const uint32_t deepest = ccd.colors[33];
  EXPECT_EQ(scheme.measure(solid(deepest)), 2048u);  // 4 · 33 > 128: raw
  EXPECT_EQ(scheme.encode(solid(deepest)).csb[0], 0);
  EXPECT_EQ(scheme.measure(solid(ccd.colors[30])), 64 * 31u);  // 4 · 31 = 124 < 128
  EXPECT_EQ(scheme.measure(solid(ccd.colors[31])), 2048u);     // 4 · 32 = 128 is not less
  EXPECT_TRUE(scheme.returns(solid(deepest)));
  EXPECT_TRUE(scheme.returns(solid(ccd.colors[30])));
}

TEST(DcpBits, TheCoverageThresholdSwitchesTheSchemeOff) {
  Ccd ccd = dictionary(64, {10, 20});
  ccd.coverage = 0.7;
  for (const std::string name : {"dcp", "adcp", "vdcp", "huffdcp"}) {
    const BlockHarness on(name + ":coverage=0.7", &ccd), off(name + ":coverage=0.71", &ccd);
    EXPECT_LT(on.measure(solid(10)), 2048u) << name;  // coverage ≥ CT keeps it on
    EXPECT_EQ(off.measure(solid(10)), 2048u) << name;
    EXPECT_EQ(off.encoder().csb_bits(), 0u) << name;
    EXPECT_EQ(off.encoder().palette_bits(), 0u) << name;
    EXPECT_TRUE(off.returns(solid(10))) << name;
  }
  const BlockHarness hybrid("hdcp:coverage=0.71", &ccd);
  EXPECT_EQ(hybrid.measure(solid(10)), 512u);  // falls back to RAS
  EXPECT_EQ(hybrid.encoder().csb_bits(), 2u);
  EXPECT_EQ(hybrid.encoder().palette_bits(), 0u);
  EXPECT_TRUE(hybrid.returns(solid(10)));
}
