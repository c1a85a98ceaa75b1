// Bitstreams of palette, FBC, TE, BDI and BPC, and the traffic that comes with them.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "block_harness.h"
#include "bpc/bpc_line.h"
#include "te/crc64.h"
#include "tilepress/surface_engine.h"

using namespace harness;
using reference::Picture;

namespace {

constexpr uint32_t A = 0xFF000001, B = 0xFF000002, C = 0xFF123456;

Picture filled(uint32_t width, uint32_t height, uint32_t color) {
  return {width, height, std::vector<uint32_t>(size_t{width} * height, color)};
}

/// One scheme on one surface, verified.
class Surface {
 public:
  explicit Surface(const std::string& scheme) : engine_({parsed(scheme)}, verifying()) {}
  const SchemeStatistics& next(const Picture& picture) {
    engine_.process(patterns::in_memory(picture).view(), statistics_);
    EXPECT_EQ(statistics_.schemes[0].mismatched_blocks, 0u);
    return statistics_.schemes[0];
  }

 private:
  static ModelOptions verifying() {
    ModelOptions options;
    options.verify = true;
    return options;
  }
  SurfaceEngine engine_;
  FrameStatistics statistics_;
};

Block ramp(uint32_t base, uint32_t step) {
  Block block;
  for (uint32_t i = 0; i < 64; ++i) block.pixels[i] = base + step * i;
  return block;
}

}  // namespace

TEST(Palette, TakesTheColoursOfTheFirstFrameForEver) {
  Surface surface("palette:entries=4");
  Picture picture = filled(8, 8, A);
  picture.words[0] = B;
  EXPECT_EQ(surface.next(picture).payload_bits, 2048u);  // known once the frame is over
  EXPECT_EQ(surface.next(picture).payload_bits, 64u * 2);
  EXPECT_EQ(surface.next(filled(8, 8, C)).payload_bits, 2048u);
  const SchemeStatistics& scheme = surface.next(filled(8, 8, C));
  EXPECT_EQ(scheme.payload_bits, 2048u);  // a new colour never enters
  EXPECT_EQ(scheme.csb_bits, 16u);
  EXPECT_EQ(scheme.palette_bits, 4u * 33);
  EXPECT_EQ(surface.next(filled(8, 8, B)).payload_bits, 64u * 2);
}

TEST(Palette, KeepsTheMostFrequentColours) {
  // Three colours, two entries: C (1 pixel) is left out.
  Picture picture = filled(8, 8, A);
  picture.words[0] = C;
  for (size_t i = 56; i < 64; ++i) picture.words[i] = B;
  Surface surface("palette:entries=2");
  surface.next(picture);
  EXPECT_EQ(surface.next(picture).payload_bits, 128u + 15 * 4);
}

TEST(Fbc, KnowsTheFrameItCompresses) {
  // 48 A, 16 B: codes of one bit each, from the first frame on.
  Picture picture = filled(8, 8, A);
  for (size_t i = 48; i < 64; ++i) picture.words[i] = B;
  Surface surface("fbc");
  const SchemeStatistics& scheme = surface.next(picture);
  EXPECT_EQ(scheme.payload_bits, 64u);
  EXPECT_EQ(scheme.palette_bits, 64u * 39);
  EXPECT_EQ(scheme.csb_bits, 16u);
}

TEST(Fbc, PaysThreePassesOverTheRawSurface) {
  Surface surface("fbc:entries=2");
  const SchemeStatistics& scheme = surface.next(filled(9, 8, A));  // two blocks
  EXPECT_EQ(scheme.extra_bits, 3u * 2 * 2048);
  const double moved = 2 * 128 + 2 * 16 + 2 * 39;  // a burst a block, CSB, two slots
  EXPECT_DOUBLE_EQ(scheme.rate(), 4096 / moved);
  EXPECT_DOUBLE_EQ(scheme.rate_with_extra(), 4096 / (moved + 12288));
}

TEST(Crc64, GivesTheCheckValueOfItsStandard) {
  // CRC-64/XZ of "123456789" is 0x995DC9BBDF1939FA. Bytes go in by words of 4 or of 2; the last digit by one.
  const std::vector<uint32_t> words = {0x34333231, 0x38373635};
  const std::vector<uint32_t> halves = {0x3231, 0x3433, 0x3635, 0x3837};
  const std::vector<uint32_t> last = {0x39};
  EXPECT_EQ(crc64(last, 1, crc64(words, 4, 0)), 0x995DC9BBDF1939FAu);
  EXPECT_EQ(crc64(last, 1, crc64(halves, 2, 0)), 0x995DC9BBDF1939FAu);
}

TEST(Te, LeavesUnchangedTilesAlone) {
  // 40×24 pixels: 5×3 blocks in 3×2 tiles of 16×16, narrow or low at the edges.
  Picture picture = filled(40, 24, A);
  Surface surface("te");
  const SchemeStatistics& first = surface.next(picture);
  EXPECT_EQ(first.payload_bits, 15u * 2048);
  EXPECT_EQ(first.palette_bits, 6u * 64);
  EXPECT_EQ(first.extra_bits, 0u);  // nothing to compare with
  EXPECT_EQ(surface.next(picture).payload_bits, 0u);
  picture.words[40 * 20 + 3] = B;  // tile (0, 1), two blocks
  const SchemeStatistics& third = surface.next(picture);
  EXPECT_EQ(third.payload_bits, 2u * 2048);
  EXPECT_EQ(third.bursts, 2u * 16);
  EXPECT_EQ(third.csb_bits, 15u);
  EXPECT_EQ(third.extra_bits, 6u * 64);
  picture.words[40 * 20 + 3] = A;
  EXPECT_EQ(surface.next(picture).payload_bits, 2u * 2048);  // back is a change too
  EXPECT_EQ(surface.next(picture).payload_bits, 0u);
}

TEST(Te, ADecoderHasNothingToLeaveInItsFirstFrame) {
  BlockHarness te("te", nullptr);
  const std::vector<uint8_t> nothing(1, 0);
  BitReader csb(nothing, 1), payload(nothing, 0);
  Block out;
  EXPECT_FALSE(te.decoder().decode_at(0, 0, csb, payload, out));
}

TEST(Bdi, TakesEachOfItsForms) {
  const BlockHarness bdi("bdi", nullptr);
  struct Row {
    Block block;
    uint32_t code, line_bits;
  };
  Block pairs, wide, halves, noise;
  patterns::Dice dice(1);
  for (uint32_t i = 0; i < 64; ++i) {
    // 8-byte elements that differ in their low 4 bytes only, by more than 2 bytes hold; 4-byte elements would
    // not do.
    wide.pixels[i] = i % 2 == 1 ? 0x7654321 : 0x20000000 + i * 0x123456;
    // Two-byte elements around 0x4040 and around zero.
    halves.pixels[i] = (0x4040 + i % 7) | (i % 5) << 16;
    pairs.pixels[i] = i % 2 == 1 ? 0x89ABCDEF : 0x01234567;
    noise.pixels[i] = dice.next();
  }
  const Row rows[] = {{solid(0), 0, 0},
                      {solid(0x01020304), 1, 64},
                      {pairs, 1, 64},
                      {ramp(0x01020304, 1), 5, 176},
                      {ramp(0x01020304, 0x1001), 15, 512},  // 15 · 0x1001 is more than 2 signed bytes hold
                      {ramp(0x01020304, 0x101), 6, 304},
                      {wide, 4, 328},
                      {halves, 7, 304},
                      {noise, 15, 512}};
  for (const Row& row : rows) {
    const Encoded bits = bdi.encode(row.block);
    EXPECT_EQ(bits.read_csb().get(4), row.code);
    EXPECT_TRUE(bdi.returns(row.block)) << "code " << row.code;
  }
  EXPECT_EQ(bdi.measure(solid(0)), 0u);
  EXPECT_EQ(bdi.measure(solid(7)), 4u * 64);
  EXPECT_EQ(bdi.measure(noise), 2048u);
  EXPECT_EQ(bdi.encoder().csb_bits(), 16u);
}

TEST(Bdi, CodesEightByteElementsWithNarrowDeltas) {
  // Every second word is the same and the others count: 8-byte elements with 1- and 2-byte differences.
  const BlockHarness bdi("bdi", nullptr);
  for (const uint32_t step : {1u, 300u}) {
    Block block;
    for (uint32_t i = 0; i < 64; ++i) block.pixels[i] = i % 2 == 1 ? 0x70707070 : 0x01020304 + i % 16 * step;
    EXPECT_EQ(bdi.measure(block), 4 * (step == 1 ? 136u : 200u));
    EXPECT_EQ(bdi.encode(block).read_csb().get(4), step == 1 ? 2u : 3u);
    EXPECT_TRUE(bdi.returns(block));
  }
}

TEST(Bdi, TheImmediateServesElementsNearZero) {
  // Half the words near zero, half near a base: one base and the mask do.
  Block block;
  for (uint32_t i = 0; i < 64; ++i) block.pixels[i] = i % 3 == 0 ? i : 0x55667700 + i;
  block.pixels[0] = static_cast<uint32_t>(-3);
  const BlockHarness bdi("bdi", nullptr);
  EXPECT_EQ(bdi.measure(block), 4u * 176);
  EXPECT_TRUE(bdi.returns(block));
}

TEST(Bpc, CodesARampInTwelveBytesOrFewer) {
  // base: 1 + 32 bits. All 31 deltas are 5 = 101: planes 2 and 0 all ones, plane 1 zero. Planes 32 … 3: a run
  // of 30 (7 bits); plane 2: DBX all ones (5); plane 1: DBX all ones (5); plane 0: all ones (5). 55 bits, 7
  // bytes.
  uint32_t words[32];
  for (uint32_t i = 0; i < 32; ++i) words[i] = 0x12345678 + 5 * i;
  EXPECT_EQ(bpc_line_bits(words), 33u + 7 + 5 + 5 + 5);
  const BlockHarness bpc("bpc", nullptr);
  const Block block = ramp(0x12345678, 5);
  EXPECT_EQ(bpc.measure(block), 2u * 56);
  EXPECT_EQ(bpc.encode(block).read_csb().get(7), 7u);
  EXPECT_EQ(bpc.encoder().csb_bits(), 14u);
  EXPECT_TRUE(bpc.returns(block));
}

TEST(Bpc, CodesSolidLinesByTheirBase) {
  // 33 zero planes are one run of 7 bits; the base takes 3, 7, 11, 19 or 33 bits.
  const BlockHarness bpc("bpc", nullptr);
  const std::pair<uint32_t, uint32_t> bases[] = {{0, 3},      {7, 7},           {0xFFFFFFF8, 7},
                                                 {8, 11},     {0xFFFFFF80, 11}, {128, 19},
                                                 {32767, 19}, {32768, 33},      {0xFF000000, 33}};
  for (const auto& [color, base_bits] : bases) {
    uint32_t words[32];
    std::fill(words, words + 32, color);
    EXPECT_EQ(bpc_line_bits(words), base_bits + 7) << color;
    EXPECT_TRUE(bpc.returns(solid(color))) << color;
  }
}

TEST(Bpc, TellsSinglePairedAndLastOnesApart) {
  // One word differs: delta +1 then −1. −1 has all 33 bits set, +1 bit 0 only. Plane 32: a single one (10
  // bits); planes 31 … 1: no change (7); plane 0: DBX has the +1 alone (10).
  uint32_t words[32];
  std::fill(words, words + 32, 100u);
  words[10] = 101;
  EXPECT_EQ(bpc_line_bits(words), 11u + 10 + 7 + 10);
  // A step of 2 that lasts two deltas: bit 1 of two neighbours (10); then plane 0 changes back to zero (5).
  for (uint32_t i = 0; i < 32; ++i) words[i] = i < 5 ? 100 : i == 5 ? 102 : 104;
  EXPECT_EQ(bpc_line_bits(words), 11u + 7 + 10 + 5);
}

TEST(Bpc, KeepsALineRawThatWouldNotFit127Bytes) {
  Block noise;
  patterns::Dice dice(3);
  for (uint32_t& word : noise.pixels) word = dice.next();
  const BlockHarness bpc("bpc", nullptr);
  EXPECT_EQ(bpc.measure(noise), 2048u);
  EXPECT_EQ(bpc.encode(noise).read_csb().get(7), 0u);
  EXPECT_TRUE(bpc.returns(noise));
}

TEST(Lines, QuadOrderPutsNeighboursSideBySide) {
  // Two colours, each in 4×4 quarters of the block: by rows a line changes every four pixels; by quads, every
  // eight.
  Block block;
  for (uint32_t i = 0; i < 64; ++i) block.pixels[i] = i % 8 < 4 ? A : C;
  const BlockHarness raster("bpc", nullptr), quad("bpc:order=quad", nullptr);
  EXPECT_LT(quad.measure(block), raster.measure(block));
  EXPECT_TRUE(raster.returns(block));
  EXPECT_TRUE(quad.returns(block));
  EXPECT_TRUE(BlockHarness("bdi:order=quad", nullptr).returns(block));
}

TEST(Lines, SixteenBitPixelsShareWords) {
  for (const char* text : {"bdi", "bpc", "bdi:order=quad", "bpc:order=quad"}) {
    const BlockHarness scheme(text, nullptr, PixelFormat::kRgb565);
    EXPECT_EQ(scheme.encoder().csb_bits(), parsed(text).name == "bdi" ? 8u : 7u);
    Block block;
    for (uint32_t i = 0; i < 64; ++i) block.pixels[i] = 0x8000 + i * 3 % 17;
    EXPECT_TRUE(scheme.returns(block)) << text;
    EXPECT_LT(scheme.measure(block), 1024u) << text;
  }
}
