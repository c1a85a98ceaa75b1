// RAS, RED and the hybrid of VDCP and RAS: streams, size classes, modes.
#include <gtest/gtest.h>

#include <algorithm>

#include "block_harness.h"
#include "memory/size_classes.h"
#include "ras/ras_samples.h"
#include "ras/ras_stream.h"
#include "tilepress/simd.h"

using namespace harness;

namespace {

Block red_ramp() {
  Block block;
  for (uint32_t i = 0; i < 64; ++i) block.pixels[i] = 0xFF000000 | (i % 8);
  return block;
}

const FormatTraits& kRgba = traits(PixelFormat::kRgba8);

uint32_t stream_bits(const Block& block, const FormatTraits& format, bool ycocg) {
  const uint32_t groups = ras_group_bits(block.pixels.data(), kBlockSide, format, ycocg);
  return groups + static_cast<uint32_t>(ras_bits_beside_groups(format, ycocg));
}
uint32_t stream_bits(const Block& block, bool ycocg) {
  return stream_bits(block, kRgba, ycocg);
}

}  // namespace

TEST(RasStream, ASolidBlockTakes224Bits) {
  // Four first pixels of 8 bits; 4 planes × 16 groups × 3 bits of k = 7.
  EXPECT_EQ(stream_bits(solid(0x12345678), false), 4u * 8 + 4 * 16 * 3);
  // Co and Cg take 9 bits for the first pixel.
  EXPECT_EQ(stream_bits(solid(0x12345678), true), 8u + 9 + 9 + 8 + 4 * 16 * 3);
  const BlockHarness ras("ras", nullptr);
  EXPECT_EQ(ras.measure(solid(0x12345678)), 512u);
  EXPECT_EQ(ras.encode(solid(0x12345678)).read_csb().get(2), 0u);
  EXPECT_TRUE(ras.returns(solid(0x12345678)));
}

TEST(RasStream, ARampCostsItsFirstRowOnly) {
  // R = x. Row 0 predicts from the left: e = 1, u = 2. Column 0 from above: 0. Elsewhere a = x−1, b = x, c =
  // x−1: c ≤ min(a, b), so max(a, b) = x: 0. Group 0 has u = 2, 0, 0: k = 0 costs 3+1+1 = 5, with its field 8
  // bits. Groups 1 … 3 have 2, 2, 0, 0: 3 + 8 = 11 each. The 12 others, and the other planes, 3 bits a group.
  EXPECT_EQ(stream_bits(red_ramp(), false), 4u * 8 + 8 + 3 * 11 + 12 * 3 + 3 * 16 * 3);
}

TEST(RasStream, TheLowestKWinsATie) {
  // R: 10 11 / 11 12: three residuals of 1, u = 2. k = 0: 3 · 3 = 9 bits, k = 1: 3 · (1 + 1 + 1) = 9 bits.
  Block block = solid(12);
  block.pixels[0] = 10;
  block.pixels[1] = block.pixels[8] = 11;
  std::vector<uint8_t> bytes(256);
  BitWriter writer(bytes);
  ras_stream_write(block, kRgba, false, writer);
  writer.flush();
  BitReader reader(bytes);
  reader.skip(32);
  EXPECT_EQ(reader.get(3), 0u);
  EXPECT_EQ(reader.get(9), 0b110110110u);
}

TEST(RasStream, ResidualsAreFoldedWithoutWrapping) {
  // R: 0, then 255 in the last pixel: e = 255, u = 510. Group 15 has 0, 0, 0, 510; k = 6 costs 3·7 + 7+7 =
  // 35, k = 5 costs 3·6 + 15+6 = 39: 3 + 35 bits instead of 3.
  Block block = solid(0);
  block.pixels[63] = 255;
  EXPECT_EQ(stream_bits(block, false), 224u + 35);
  // The other way round e = −255, u = 509.
  block = solid(255);
  block.pixels[63] = 0;
  EXPECT_EQ(stream_bits(block, false), 224u + 35);
  EXPECT_TRUE(BlockHarness("ras", nullptr).returns(block));
}

TEST(RasStream, IsTheSameWhereverItBegins) {
  // Behind an odd bit, or with no room to spare behind it, it is written another way.
  patterns::Dice dice(8);
  for (uint32_t round = 0; round < 300; ++round)
    for (const PixelFormat pixel_format : {PixelFormat::kRgba8, PixelFormat::kRgb10a2})
      for (const bool ycocg : {false, true}) {
        const FormatTraits& format = traits(pixel_format);
        Block block, read;
        const uint32_t mask = (1u << dice.below(11)) - 1;
        for (uint32_t& word : block.pixels) word = (dice.next() & mask * 0x00100401u) | 0x80000000u;
        const uint32_t bits = stream_bits(block, format, ycocg);
        for (const uint32_t before : {0u, 3u}) {
          std::vector<uint8_t> bytes((before + bits + 7) / 8 + (round % 2 != 0 ? 16 : 0));
          BitWriter writer(bytes);
          writer.put(0, before);
          ras_stream_write(block, format, ycocg, writer);
          ASSERT_EQ(writer.bit_count(), before + bits);
          writer.flush();
          BitReader reader(bytes);
          reader.skip(before);
          ASSERT_TRUE(ras_stream_read(reader, format, ycocg, read));
          ASSERT_EQ(reader.position(), before + bits);
          ASSERT_EQ(read, block);
        }
      }
}

TEST(SizeClasses, ThreeSizesEndAtQuarters) {
  const SizeClasses classes{SizeChoice::kThree, 2048, 128};
  EXPECT_EQ(classes.csb_bits(), 2u);
  const std::pair<uint32_t, uint32_t> sizes[] = {{1, 512},     {224, 512},   {512, 512},
                                                 {513, 1024},  {1024, 1024}, {1025, 1536},
                                                 {1536, 1536}, {1537, 2048}, {4000, 2048}};
  for (const auto& [stream, payload] : sizes)
    EXPECT_EQ(classes.bits_of(classes.class_of(stream)), payload) << stream;
}

TEST(SizeClasses, TwoSizesEndAtTheHalf) {
  const SizeClasses classes{SizeChoice::kTwo, 2048, 128};
  EXPECT_EQ(classes.csb_bits(), 2u);
  EXPECT_EQ(classes.bits_of(classes.class_of(512)), 512u);
  EXPECT_EQ(classes.bits_of(classes.class_of(1024)), 1024u);
  EXPECT_EQ(classes.bits_of(classes.class_of(1025)), 2048u);
  EXPECT_FALSE(classes.valid(2));
}

TEST(SizeClasses, BurstSizesAreWholeBursts) {
  const SizeClasses classes{SizeChoice::kBurst, 2048, 128};
  EXPECT_EQ(classes.bits_of(classes.class_of(224)), 256u);
  EXPECT_EQ(classes.bits_of(classes.class_of(256)), 256u);
  EXPECT_EQ(classes.bits_of(classes.class_of(257)), 384u);
  EXPECT_EQ(classes.bits_of(classes.class_of(1920)), 1920u);
  EXPECT_EQ(classes.bits_of(classes.class_of(1921)), 2048u);
  EXPECT_FALSE(classes.valid(0));
  // ceil(log2(2048/burst + 1)): 17 values for 16 bursts.
  const std::pair<uint32_t, uint32_t> widths[] = {{128, 5}, {64, 6}, {256, 4}, {512, 3}, {2048, 1}, {16, 8}};
  for (const auto& [burst, bits] : widths)
    EXPECT_EQ((SizeClasses{SizeChoice::kBurst, 2048, burst}.csb_bits()), bits) << burst;
}

TEST(RasBits, EveryClassDecodes) {
  ModelOptions model;
  for (const uint32_t burst : {64u, 128u, 1024u, 2048u}) {
    model.burst_bits = burst;
    for (const char* text : {"ras", "ras:sizes=2", "ras:sizes=burst", "ras:ycocg=1"})
      for (const PixelFormat format : {PixelFormat::kRgba8, PixelFormat::kRgb565, PixelFormat::kRgb10a2}) {
        const BlockHarness ras(text, nullptr, format, model);
        patterns::Dice dice(burst);
        for (uint32_t spread = 0; spread < 16; ++spread) {
          Block block;
          const uint32_t color = dice.next();
          for (uint32_t& word : block.pixels)
            word = patterns::fit(color ^ (dice.next() & dice.next() & ((1u << spread) - 1) * 0x00010101),
                                 format);
          EXPECT_TRUE(ras.returns(block)) << text << " burst " << burst << " spread " << spread;
        }
      }
  }
}

TEST(Red, TellsItsThreeModesApart) {
  const BlockHarness red("red", nullptr);
  Block block = solid(1);
  for (uint32_t i = 0; i < 64; ++i) block.pixels[i] = i / 16 * 2 + i % 8 / 4;  // eight 4×2 regions
  EXPECT_EQ(red.measure(block), 256u);
  EXPECT_EQ(red.encode(block).read_csb().get(2), 0u);
  EXPECT_EQ(red.encode(block).read_payload().get(32), 0u);
  EXPECT_TRUE(red.returns(block));
  for (uint32_t i = 0; i < 64; ++i) block.pixels[i] = i % 8 / 2;  // uniform 2×8 columns: not 4×2, but 2×2
  EXPECT_EQ(red.measure(block), 512u);
  EXPECT_EQ(red.encode(block).read_csb().get(2), 1u);
  EXPECT_TRUE(red.returns(block));
  block.pixels[63] = 77;
  EXPECT_EQ(red.measure(block), 2048u);
  EXPECT_EQ(red.encode(block).read_csb().get(2), 2u);
  EXPECT_TRUE(red.returns(block));
}

TEST(Hybrid, GivesVdcpTheBlockOnATieOfBursts) {
  std::vector<uint32_t> colors;
  for (uint32_t i = 0; i < 512; ++i) colors.push_back(0x01000001 + i);
  const Ccd ccd = dictionary(512, colors);
  const BlockHarness hybrid("hdcp:fvc=512", &ccd);
  // A solid block is 512 bits for RAS. Index 128 needs 8 bits: 64 · 8 = 512 bits, as many bursts.
  const Block tie = solid(colors[128]);
  EXPECT_EQ(hybrid.measure(tie), 512u);
  EXPECT_EQ(hybrid.encode(tie).read_csb().get(5), 8u);
  // Index 256 needs 9 bits: 576 bits, one burst more than RAS. The CSB then says 16 + class 0, sixteen times.
  const Block ras = solid(colors[256]);
  EXPECT_EQ(hybrid.measure(ras), 512u);
  EXPECT_EQ(hybrid.encode(ras).read_csb().get(5), 16u);
  EXPECT_TRUE(hybrid.returns(tie));
  EXPECT_TRUE(hybrid.returns(ras));
  EXPECT_EQ(hybrid.encoder().csb_bits(), 80u);  // 5 bits a sub-block
}

TEST(Hybrid, CountsBurstsNotBits) {
  // Index 256 takes 9 bits a pixel, 576 for the block, where RAS takes 512: both one burst of 1024, so
  // VDCP's.
  std::vector<uint32_t> colors;
  for (uint32_t i = 0; i < 512; ++i) colors.push_back(0x01000001 + i);
  const Ccd ccd = dictionary(512, colors);
  ModelOptions wide;
  wide.burst_bits = 1024;
  const BlockHarness hybrid("hdcp:fvc=512", &ccd, PixelFormat::kRgba8, wide);
  EXPECT_EQ(hybrid.measure(solid(colors[256])), 576u);
}

TEST(Hybrid, GivesRasWhatItCompressesWhileThereIsNoDictionary) {
  const Block block = solid(10);
  // VDCP is raw then; a block that is raw on both sides is VDCP's.
  const BlockHarness fresh("hdcp", nullptr);
  EXPECT_EQ(fresh.measure(block), 512u);
  Block noise;
  patterns::Dice dice(1);
  for (uint32_t& word : noise.pixels) word = dice.next();
  EXPECT_EQ(fresh.measure(noise), 2048u);
  EXPECT_EQ(fresh.encode(noise).read_csb().get(5), 31u);
  EXPECT_TRUE(fresh.returns(noise));
}
