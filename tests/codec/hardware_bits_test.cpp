// Bitstreams of intel8, intel11 and amddcc, derived from the layouts that their file heads draw.
#include <gtest/gtest.h>

#include <functional>

#include "block_harness.h"
#include "pixels/low_first_bits.h"
#include "tilepress/surface_engine.h"

using namespace harness;

namespace {

constexpr uint32_t kColor = 0x44332211;  // R = 0x11, G = 0x22, B = 0x33, A = 0x44

uint32_t gray(uint32_t value, uint32_t alpha = 255) {
  return value | value << 8 | value << 16 | alpha << 24;
}
Block drawn(const std::function<uint32_t(uint32_t x, uint32_t y)>& color) {
  Block block;
  for (uint32_t i = 0; i < 64; ++i) block.pixels[i] = color(i % 8, i / 8);
  return block;
}
/// Replaces the pixels for which `where` is true by noise.
Block with_noise(Block block, const std::function<bool(uint32_t x, uint32_t y)>& where) {
  patterns::Dice dice(7);
  for (uint32_t i = 0; i < 64; ++i) {
    const uint32_t noise = dice.next();
    if (where(i % 8, i / 8)) block.pixels[i] = noise;
  }
  return block;
}
Block noise() {
  return with_noise(solid(0), [](uint32_t, uint32_t) { return true; });
}
/// `bytes`, then zeros.
std::vector<uint8_t> padded(std::vector<uint8_t> bytes, size_t size) {
  bytes.resize(size);
  return bytes;
}
std::vector<uint8_t> bytes_at(const Encoded& bits, size_t at, size_t size) {
  return {bits.payload.begin() + static_cast<long>(at), bits.payload.begin() + static_cast<long>(at + size)};
}
Encoded altered(Encoded bits, const std::vector<uint8_t>& start) {
  std::copy(start.begin(), start.end(), bits.payload.begin());
  return bits;
}
bool decodes(const BlockHarness& scheme, const Encoded& bits) {
  Block out;
  return scheme.decode(bits, out);
}

}  // namespace

TEST(Intel8, WritesConstantChannelsAsTheirBases) {
  // 4 flags of ones, then the bases from bit 4 on: a nibble 1111, then 11 22 33 44, low nibbles first.
  const BlockHarness intel("intel8", nullptr);
  const Encoded bits = intel.encode(solid(kColor));
  EXPECT_EQ(bits.payload_bits, 2u * 512);
  EXPECT_EQ(bits.read_csb().get(4), 0b0101u);
  const auto pair = padded({0x1F, 0x21, 0x32, 0x43, 0x04}, 64);
  EXPECT_EQ(bytes_at(bits, 0, 64), pair);
  EXPECT_EQ(bytes_at(bits, 64, 64), pair);
  EXPECT_TRUE(intel.returns(solid(kColor)));
}

TEST(Intel8, PutsEachPixelIntoItsFourteenBits) {
  // R differs by one in pixel (1, 0), the second of the left line, and in pixel (4, 0), the first of the
  // right line: bits 48 + 14 and 48 + 16 · 14 = 272. R's flag is 0, its width 1 is stored as 0.
  const Block block = drawn([](uint32_t x, uint32_t y) { return kColor + (y == 0 && (x == 1 || x == 4)); });
  const BlockHarness intel("intel8", nullptr);
  auto pair = padded({0x1E, 0x21, 0x32, 0x43, 0x04}, 64);
  pair[62 / 8] = 1 << 62 % 8;
  pair[272 / 8] = 1 << 272 % 8;
  EXPECT_EQ(bytes_at(intel.encode(block), 0, 64), pair);
  EXPECT_TRUE(intel.returns(block));
}

TEST(Intel8, CompressesPairsOfAtMostFourteenBits) {
  const BlockHarness intel("intel8", nullptr);
  for (const uint32_t span : {63u, 64u}) {  // 8 bits of R, and 6 or 7 bits of G in the upper pair
    const Block block = drawn([&](uint32_t x, uint32_t y) {
      return kColor - 0x11 + (x == 3 && y == 3 ? 255 : 0) + (x == 7 && y == 0 ? span << 8 : 0);
    });
    EXPECT_EQ(intel.measure(block), span == 63 ? 1024u : 1536u);
    EXPECT_EQ(intel.encode(block).read_csb().get(4), span == 63 ? 0b0101u : 0b0001u);
    EXPECT_TRUE(intel.returns(block));
  }
}

TEST(Intel8, StoresRawPairsAsTheirBytes) {
  const Block block = noise();
  const BlockHarness intel("intel8", nullptr);
  const Encoded bits = intel.encode(block);
  EXPECT_EQ(bits.payload_bits, 2048u);
  EXPECT_EQ(bits.read_csb().get(4), 0u);
  for (uint32_t byte = 0; byte < 4; ++byte) {
    EXPECT_EQ(bits.payload[byte], block.pixels[0] >> 8 * byte & 0xFF);
    EXPECT_EQ(bits.payload[16 + byte], block.pixels[8] >> 8 * byte & 0xFF);  // the line's second row
    EXPECT_EQ(bits.payload[64 + byte], block.pixels[4] >> 8 * byte & 0xFF);  // the right line
  }
  EXPECT_TRUE(intel.returns(block));
}

TEST(Intel8, RefusesWhatNoEncoderWrites) {
  const BlockHarness intel("intel8", nullptr);
  Encoded bits = intel.encode(solid(0));
  EXPECT_TRUE(decodes(intel, bits));
  EXPECT_FALSE(decodes(intel, altered(bits, {0x0F, 0, 0, 0, 0x10})));        // constant, with a width
  EXPECT_FALSE(decodes(intel, altered(bits, {0, 0, 0, 0, 0xF0, 0xFF})));     // 32 bits a pixel
  EXPECT_TRUE(decodes(intel, altered(bits, {0x0C, 0, 0, 0, 0xF0, 0x01})));   // R 8, G 4: 12 bits
  EXPECT_FALSE(decodes(intel, altered(bits, {0x0C, 0, 0, 0, 0xF0, 0x03})));  // R 8, G 8: 16 bits
  bits.csb[0] = 0b10010000;
  EXPECT_FALSE(decodes(intel, bits));  // status 2
}

TEST(Intel11, WritesAPairOfOneColourInHalfALine) {
  // Nothing is inter, extended or wider than 0; A gets the six bits of the slot.
  const BlockHarness intel("intel11", nullptr);
  const Encoded bits = intel.encode(solid(kColor));
  EXPECT_EQ(bits.payload_bits, 2u * 256);
  EXPECT_EQ(bits.read_csb().get(8), 0x11u);
  BitReader reader = bits.read_payload();
  LowFirstBits unit = LowFirstBits::read(reader, 32);
  EXPECT_EQ(unit.get(1 + 8 + 12), 0u);
  EXPECT_EQ(unit.get(32), kColor);
  EXPECT_TRUE(intel.returns(solid(kColor)));
}

TEST(Intel11, TakesTheSmallestMode) {
  const auto left = [](uint32_t x, uint32_t) { return x < 4; };
  const auto right = [](uint32_t x, uint32_t) { return x >= 4; };
  // Every line has 8 bits of R and 6 of G, and no smaller window of R.
  const Block fourteen =
      drawn([](uint32_t x, uint32_t y) { return (x + y) % 4 * 85 | x % 2 * 63 << 8 | 0xFF000000; });
  const struct {
    Block block;
    uint32_t mode, pair_bits;
  } rows[] = {{solid(kColor), 1, 256},
              {drawn([](uint32_t x, uint32_t) { return x < 4 ? 0 : ~0u; }), 10, 512},
              {fourteen, 6, 512},
              {with_noise(solid(kColor), right), 2, 768},
              {with_noise(solid(kColor), left), 8, 768},
              {noise(), 0, 1024}};
  const BlockHarness intel("intel11", nullptr);
  for (const auto& row : rows) {
    EXPECT_EQ(intel.measure(row.block), 2 * row.pair_bits) << row.mode;
    EXPECT_EQ(intel.encode(row.block).read_csb().get(8), row.mode << 4 | row.mode);
    EXPECT_TRUE(intel.returns(row.block)) << row.mode;
  }
}

TEST(Intel11, PredictsAcrossChannels) {
  // Gray from 7 on, six bits: B takes six, R = B and G = (B + R) / 2 nothing. Slots stand by 2×2 blocks.
  const Block block = drawn([](uint32_t x, uint32_t y) { return gray(7 + (8 * y + x) % 32 * 2); });
  const BlockHarness intel("intel11", nullptr);
  const Encoded bits = intel.encode(block);
  EXPECT_EQ(bits.read_csb().get(8), 0x11u);
  BitReader reader = bits.read_payload();
  LowFirstBits unit = LowFirstBits::read(reader, 32);
  EXPECT_EQ(unit.get(1), 1u);
  EXPECT_EQ(unit.get(8), 0u);
  EXPECT_EQ(unit.get(12), 6u);              // widths of B, R, G
  EXPECT_EQ(unit.get(32), 0xFF000007u);     // bases of B, R, G, A
  EXPECT_EQ(unit.get(12), 0u | 2u << 6);    // pixels (0, 0) and (1, 0)
  EXPECT_EQ(unit.get(12), 16u | 18u << 6);  // (0, 1) and (1, 1)
  EXPECT_EQ(unit.get(12), 4u | 6u << 6);    // (2, 0) and (3, 0)
  EXPECT_TRUE(intel.returns(block));
}

TEST(Intel11, PredictsModulo256) {
  // B takes three bits. R − B is 1 or −1, a window from 255 on of two bits. G is its prediction.
  const Block block = drawn([](uint32_t x, uint32_t) {
    const uint32_t b = 100 + x, r = x % 2 == 0 ? b + 1 : b - 1;
    return r | (r + b) / 2 << 8 | b << 16;
  });
  const BlockHarness intel("intel11", nullptr);
  const Encoded bits = intel.encode(block);
  EXPECT_EQ(bits.read_csb().get(8), 0x11u);
  BitReader reader = bits.read_payload();
  LowFirstBits unit = LowFirstBits::read(reader, 32);
  EXPECT_EQ(unit.get(9), 1u);
  EXPECT_EQ(unit.get(12), 3u | 2u << 4);       // widths of B, R, G
  EXPECT_EQ(unit.get(32), 100u | 255u << 8);   // bases of B, R, G, A
  EXPECT_EQ(unit.get(12), 2u << 3 | 1u << 6);  // B and R of (0, 0): 0, 1 − 255; of (1, 0): 1, 0
  EXPECT_TRUE(intel.returns(block));
}

TEST(Intel11, ExtendsPairsWithFourBlocksOfOneColour) {
  // Each line has four colours with 8 + 7 + 7 bits of R, G, B. The left columns are uniform by 2×2 blocks.
  constexpr uint32_t kColors[] = {0xFF007F00, 0xFF7F00FF, 0xFF0040AA, 0xFF400055};
  const auto picture = [&](uint32_t uniform_columns) {
    return drawn([&](uint32_t x, uint32_t y) {
      return kColors[(x < uniform_columns ? x / 2 + y / 2 * 2 : x + 2 * y) % 4];
    });
  };
  const BlockHarness intel("intel11", nullptr);
  for (const uint32_t uniform_columns : {4u, 6u, 8u}) {  // four, six and eight blocks; the first four count
    const Block block = picture(uniform_columns);
    const Encoded bits = intel.encode(block);
    EXPECT_TRUE(intel.returns(block));
    EXPECT_EQ(bits.payload_bits, 1024u);
    EXPECT_EQ(bits.read_csb().get(8), 0x66u);
    BitReader reader = bits.read_payload();
    LowFirstBits unit = LowFirstBits::read(reader, 64);
    unit.skip(1);
    EXPECT_EQ(unit.get(8), 0x0Fu);
    unit.skip(44 + 4 * 14);  // widths, bases, the low parts of the four blocks
    const uint32_t low = unit.get(14);
    unit.skip(15 * 14 + 4 * 8);
    const uint32_t slot = low | unit.get(8) << 14;  // pixel (4, 0): R 8 bits, G 7, B 7, bases 0
    const uint32_t pixel = block.pixels[4];
    EXPECT_EQ(slot, (pixel & 0xFF) | (pixel >> 8 & 0x7F) << 8 | (pixel >> 16 & 0x7F) << 15);
  }
  EXPECT_EQ(intel.measure(picture(2)), 2048u);  // two blocks do not do
}

TEST(Intel11, RefusesWhatNoEncoderWrites) {
  const BlockHarness intel("intel11", nullptr);
  Encoded bits = intel.encode(solid(0));
  EXPECT_TRUE(decodes(intel, bits));
  EXPECT_FALSE(decodes(intel, altered(bits, {0, 9 << 1})));  // a width of 9
  EXPECT_FALSE(decodes(intel, altered(bits, {0, 7 << 1})));  // more than the slot's six bits
  EXPECT_FALSE(decodes(intel, altered(bits, {0x1E})));       // an extended pair in half a line
  for (uint32_t mode = 0; mode < 16; ++mode) {
    Encoded other = intel.encode(solid(0));
    other.payload.assign(256, 0);
    other.payload_bits = 2048;
    other.csb[0] = static_cast<uint8_t>(mode << 4 | mode);
    const bool known = mode <= 2 || mode == 6 || mode == 8 || mode == 10;
    EXPECT_EQ(decodes(intel, other), known) << mode;
    if (mode != 6) continue;
    EXPECT_TRUE(decodes(intel, altered(other, {0x1E})));   // four blocks
    EXPECT_FALSE(decodes(intel, altered(other, {0x0E})));  // three
    EXPECT_FALSE(decodes(intel, altered(other, {0x3E})));  // five
  }
}

TEST(AmdDcc, WritesABlockOfOneColourAsBytes) {
  // Per line: G and A have a byte left and are constant, Cr and Cb are 0 without a byte.
  const BlockHarness amd("amddcc", nullptr);
  const Encoded bits = amd.encode(solid(gray(0x80)));
  EXPECT_EQ(bits.payload_bits, 512u);
  EXPECT_EQ(bits.read_csb().get(8), 0x28u);
  EXPECT_EQ(bytes_at(bits, 0, 64), padded({0x41, 0xFF, 0x41, 0xFF, 0x41, 0xFF, 0x41, 0xFF, 0x80, 0xFF, 0x80,
                                           0xFF, 0x80, 0xFF, 0x80, 0xFF},
                                          64));
  EXPECT_TRUE(amd.returns(solid(gray(0x80))));
}

TEST(AmdDcc, WritesRampsInOnePlaneAndInSigns) {
  // Rising by one: differences 1 in u1, l1, u2, u3, l3 (bits 1, 3, 4, 5, 7) and in u0 of the right half.
  const BlockHarness amd("amddcc", nullptr);
  const Block rising = drawn([](uint32_t x, uint32_t) { return gray(x); });
  EXPECT_EQ(
      bytes_at(amd.encode(rising), 0, 64),
      padded({0x41, 0xFC, 0x41, 0xFC, 0x41, 0xFC, 0x41, 0xFC, 0x02, 0xFF, 0x02, 0xFF, 0x02, 0xFF, 0x02, 0xFF,
              0x00, 0xBA, 0x00, 0xBB, 0x00, 0xBA, 0x00, 0xBB, 0x00, 0xBA, 0x00, 0xBB, 0x00, 0xBA, 0x00, 0xBB},
             64));
  EXPECT_TRUE(amd.returns(rising));
  // Falling from 7: the differences are −1 = 255 − 0, signs without a plane. 7 = 11 above bit 0, then s = 1.
  const Block falling = drawn([](uint32_t x, uint32_t) { return gray(7 - x); });
  EXPECT_EQ(bytes_at(amd.encode(falling), 0, 64),
            padded({0x41, 0xFC, 0x41, 0xFC, 0x41, 0xFC, 0x41, 0xFC, 0x07, 0xFF, 0x07, 0xFF,
                    0x07, 0xFF, 0x07, 0xFF, 0xBB, 0xBB, 0xBB, 0xBB, 0xBB, 0xBB, 0xBB, 0xBB},
                   64));
  EXPECT_TRUE(amd.returns(falling));
}

TEST(AmdDcc, CodesEachChannelInItsSmallestForm) {
  // Gray by columns: flags (left byte, right byte, left constant, right constant) of G, bytes of a line.
  const struct {
    std::array<uint32_t, 8> columns;
    uint32_t flags, bytes;
  } rows[] = {
      {{0, 0, 0, 0, 0, 0, 0, 0}, 0b0011, 0},
      {{5, 5, 5, 5, 5, 5, 5, 5}, 0b1011, 1},
      {{5, 5, 5, 5, 6, 6, 6, 6}, 0b1111, 2},
      {{0, 0, 0, 0, 6, 6, 6, 6}, 0b1111, 2},
      {{5, 5, 5, 5, 5, 8, 5, 8}, 0b1110, 1 + 2 + 2},  // 3 and −3 = 255 − 2: two planes
      {{0, 0, 0, 0, 0, 8, 0, 8}, 0b1110, 1 + 2 + 4},
      {{0, 1, 2, 3, 3, 3, 3, 3}, 0b1001, 2 + 1},
      {{0, 63, 0, 63, 63, 63, 63, 63}, 0b1001, 2 + 6},  // as large as without a byte
      {{0, 64, 0, 64, 64, 64, 64, 64}, 0b0001, 1 + 7},
      {{0, 64, 0, 64, 65, 65, 65, 65}, 0b0101, 1 + 7 + 1},
      {{0, 1, 2, 3, 9, 9, 9, 9}, 0b1101, 2 + 1 + 1},
      {{0, 1, 2, 3, 4, 5, 6, 7}, 0b1000, 3 + 1 + 1},
      {{0, 1, 2, 3, 99, 98, 97, 96}, 0b1100, 4 + 1},     // −1 takes no plane, the step between takes seven
      {{0, 1, 2, 3, 9, 10, 11, 12}, 0b1100, 4 + 1 + 1},  // apart; together they would take 3 + 3 + 3
  };
  const BlockHarness amd("amddcc", nullptr);
  for (const auto& row : rows) {
    const Block block = drawn([&](uint32_t x, uint32_t) { return gray(row.columns[x], 0); });
    const Encoded bits = amd.encode(block);
    const uint32_t bytes = bits.payload[0], constants = bits.payload[1];
    EXPECT_EQ((bytes & 1) << 3 | (bytes & 2) << 1 | (constants & 1) << 1 | (constants & 2) >> 1, row.flags);
    EXPECT_EQ(bits.payload_bits, 4 * (2 + row.bytes) <= 64 ? 512u : 1024u);
    EXPECT_TRUE(amd.returns(block)) << row.flags;
  }
}

TEST(AmdDcc, GroupsConsecutiveLines) {
  // A quarter: 2 + 17 bytes of G in seven planes, and 7 of A in two: two lines fit, three do not.
  const Block quarters = drawn([](uint32_t x, uint32_t) { return gray(x % 2 * 100, x % 2 * 3); });
  const auto noisy = [](const char* lines) {
    return with_noise(solid(kColor), [lines](uint32_t, uint32_t y) { return lines[y / 2] == 'n'; });
  };
  const struct {
    Block block;
    uint32_t code, bits;
  } rows[] = {{noisy("...."), 0x28, 512},  {noisy("...n"), 0xCC, 1024}, {noisy("n..."), 0xCD, 1024},
              {quarters, 0x67, 1024},      {noisy("..nn"), 0x66, 1536}, {noisy("n..n"), 0x65, 1536},
              {noisy("nn.."), 0x64, 1536}, {noisy(".n.n"), 0x00, 2048}, {noise(), 0x00, 2048}};
  const BlockHarness amd("amddcc", nullptr);
  for (const auto& row : rows) {
    EXPECT_EQ(amd.measure(row.block), row.bits) << row.code;
    EXPECT_EQ(amd.encode(row.block).read_csb().get(8), row.code);
    EXPECT_TRUE(amd.returns(row.block)) << row.code;
  }
}

TEST(AmdDcc, RefusesWhatNoEncoderWrites) {
  const BlockHarness amd("amddcc", nullptr);
  const Encoded bits = amd.encode(solid(0));  // flags 00 FF
  EXPECT_TRUE(decodes(amd, bits));
  for (const uint32_t flags : {0b0000u, 0b0010u, 0b0100u, 0b0110u, 0b0111u, 0b1010u}) {
    const auto bytes = static_cast<uint8_t>(flags >> 3 | (flags >> 2 & 1) << 1);
    const auto constants = static_cast<uint8_t>(0xFC | (flags >> 1 & 1) | (flags & 1) << 1);
    EXPECT_FALSE(decodes(amd, altered(bits, {bytes, constants}))) << flags;
  }
  EXPECT_FALSE(decodes(amd, altered(bits, {1, 0xFC})));  // a byte of 0 says no number of planes
  // Eight halves of 7 planes a line, four lines: more than 64 bytes.
  Encoded long_group = altered(bits, {0x55, 0, 0x55, 0, 0x55, 0, 0x55, 0});
  std::fill(long_group.payload.begin() + 8, long_group.payload.begin() + 64, 0x80);
  EXPECT_FALSE(decodes(amd, long_group));
  Encoded unknown = bits;
  unknown.csb[0] = 0x29;
  EXPECT_FALSE(decodes(amd, unknown));
}

TEST(GpuFormats, LeaveSurfacesOutWhoseChannelsDoNotHaveEightBits) {
  const reference::Picture picture{8, 8, std::vector<uint32_t>(64, 0x1234)};
  for (const PixelFormat format :
       {PixelFormat::kRgba8, PixelFormat::kRgbx8, PixelFormat::kRgb565, PixelFormat::kRgb10a2}) {
    const bool supported = format == PixelFormat::kRgba8 || format == PixelFormat::kRgbx8;
    SurfaceEngine engine({parsed("intel8"), parsed("intel11"), parsed("amddcc"), parsed("red")}, {});
    FrameStatistics statistics;
    engine.process(patterns::in_memory(picture, format).view(), statistics);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(statistics.schemes[i].skipped, !supported);
      EXPECT_EQ(statistics.schemes[i].raw_bits, supported ? 2048u : 0u);
    }
    EXPECT_FALSE(statistics.schemes[3].skipped);
    EXPECT_GT(statistics.schemes[3].payload_bits, 0u);
  }
}
