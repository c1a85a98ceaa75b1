// LCC: bits derived by hand from the rules in lcc_symbols.h and lcc_scheme.cpp, what its tables are learned
// from, and its kernels.
#include <gtest/gtest.h>

#include "block_harness.h"
#include "kernel_targets.h"
#include "lcc/lcc_codes.h"
#include "lcc/lcc_kernels.h"
#include "tilepress/surface_engine.h"

using namespace harness;

namespace {

constexpr uint32_t kWhite = 0xFFFFFFFF, kClear = 0x00123456;

/// Entries that cover enough pixels to be sent.
Ccd large_dictionary() {
  std::vector<uint32_t> colors;
  for (uint32_t i = 0; i < 64; ++i) colors.push_back(0xFF000000u + 0x10203 * i);
  return dictionary(64, colors);
}
uint32_t status_of(const Encoded& bits) {
  return static_cast<uint32_t>(bits.read_csb().get(bits.csb_bits));
}
reference::Picture waves(uint32_t side, uint32_t shift) {
  reference::Picture picture{side, side, {}};
  for (uint32_t i = 0; i < side * side; ++i) {
    const uint32_t x = i % side, y = i / side, value = (x * x / 3 + y * (x + shift)) / 16 & 255;
    picture.words.push_back(value | ((value / 2 + y) & 255) << 8 | (255 - value) << 16 | 0xFF000000u);
  }
  return picture;
}

}  // namespace

TEST(Lcc, CodesABlockOfAPaletteColorByItsStatusAlone) {
  const Ccd ccd = large_dictionary();
  const BlockHarness lcc("lcc", &ccd);
  const Encoded bits = lcc.encode(solid(ccd.colors[5]));
  EXPECT_EQ(bits.payload_bits, 0u);
  EXPECT_EQ(bits.csb_bits, 7u);  // of 64 colours, raw, and 16 bursts
  EXPECT_EQ(status_of(bits), 5u);
  EXPECT_TRUE(lcc.returns(solid(ccd.colors[63])));
}

TEST(Lcc, CodesOtherBlocksOfOneColorAsEqualNeighbors) {
  // Without tables "equal to the left inside an area of one colour" has a code of one bit.
  const BlockHarness without("lcc", nullptr);
  EXPECT_EQ(without.tables_written(), 0u);
  const Encoded opaque = without.encode(solid(kWhite));
  EXPECT_EQ(opaque.payload_bits, 1u + 24 + 63);
  EXPECT_EQ(status_of(opaque), 64u + 1);
  EXPECT_EQ(without.measure(solid(kClear)), 1u + 32 + 63);
  const Ccd ccd = large_dictionary();
  const BlockHarness with("lcc", &ccd);
  EXPECT_EQ(with.tables_written(), 64u * 33);
  EXPECT_EQ(with.measure(solid(kWhite)), 1u + 1 + 24 + 63);
}

TEST(Lcc, CodesAPaletteColorAmongOthersByItsIndex) {
  // Pixel 0 and pixel 63 are colours of the CCD: 1 + 6 bits and a token + 6 bits.
  const Ccd ccd = large_dictionary();
  const BlockHarness lcc("lcc", &ccd);
  Block block = solid(ccd.colors[1]);
  block.pixels[63] = ccd.colors[40];
  const uint32_t palette = LccLengths::fixed().of[lcc_token_symbol(0, 0, LccToken::kPalette)];
  EXPECT_EQ(lcc.measure(block), 1u + 6 + 62 + palette + 6);
  EXPECT_TRUE(lcc.returns(block));
}

TEST(Lcc, CodesASmallStepOfLumaAsOneResidual) {
  // Gray 100, one pixel of gray 101: luma +1 folds to 2, class 2 of the flattest context.
  const BlockHarness lcc("lcc", nullptr);
  Block block = solid(0xFF646464);
  block.pixels[63] = 0xFF656565;
  const LccLengths& fixed = LccLengths::fixed();
  EXPECT_EQ(lcc.measure(block), 1u + 24 + 62 + fixed.of[lcc_token_symbol(0, 0, LccToken::kLuma)] +
                                    fixed.of[lcc_class_symbol(0, 0, 0) - kLccLumaAlone + 2]);
  EXPECT_TRUE(lcc.returns(block));
}

TEST(Lcc, StoresNoiseRaw) {
  patterns::Dice dice(3);
  Block block;
  for (uint32_t& pixel : block.pixels) pixel = dice.next();
  const BlockHarness lcc("lcc", nullptr);
  EXPECT_EQ(lcc.measure(block), 2048u);
  EXPECT_EQ(status_of(lcc.encode(block)), 64u);
  EXPECT_TRUE(lcc.returns(block));
}

TEST(Lcc, ClassesAndRestsGiveEachResidualBack) {
  for (uint32_t folded = 0; folded < 256; ++folded) {
    const auto value = static_cast<uint8_t>(folded);
    const uint8_t number = lcc_class(value), bits = lcc_bits_after(number);
    ASSERT_LT(number, kLccClasses);
    ASSERT_EQ(lcc_folded(number, lcc_rest(value, bits)), folded);
    ASSERT_EQ(lcc_size(value), std::bit_width(folded));
  }
}

TEST(Lcc, LearnedLengthsFitTheirTable) {
  // Counts that grow as Fibonacci numbers make the longest codes.
  LccCounts counts{};
  for (uint32_t i = 0; i < kLccSymbols; ++i) counts[i] = i % 17 < 2 ? 1 : counts[i - 1] + counts[i - 2];
  for (const uint32_t scale : {0u, 1u, 1000u}) {
    LccCounts scaled = counts;
    for (uint32_t& count : scaled) count *= scale;
    for (const uint8_t length : LccLengths::learned(scaled).of) {
      ASSERT_GE(length, 1u);
      ASSERT_LE(length, 14u);
    }
  }
}

TEST(Lcc, LearnsItsCodesFromTheFrameBefore) {
  // A large picture pays for its tables, a small one and noise do not.
  for (const auto& [side, pays] : {std::pair{256u, true}, std::pair{16u, false}}) {
    SurfaceEngine engine({parsed("lcc")}, ModelOptions{.verify = true});
    FrameStatistics first, second;
    const auto a = patterns::in_memory(waves(side, 0), PixelFormat::kRgba8);
    const auto b = patterns::in_memory(waves(side, 3), PixelFormat::kRgba8);
    engine.process(a.view(), first);
    engine.process(b.view(), second);
    EXPECT_EQ(first.schemes[0].palette_bits, 0u);
    EXPECT_EQ(second.schemes[0].palette_bits >= LccLengths::kTableBits, pays) << side;
    EXPECT_EQ(first.schemes[0].mismatched_blocks + second.schemes[0].mismatched_blocks, 0u);
    if (pays) {
      EXPECT_LT(second.schemes[0].payload_bits, first.schemes[0].payload_bits);
    }
  }
}

TEST(Lcc, LearnsNothingFromNoise) {
  patterns::Dice dice(5);
  SurfaceEngine engine({parsed("lcc")}, ModelOptions{});
  for (int frame = 0; frame < 3; ++frame) {
    reference::Picture picture{64, 64, std::vector<uint32_t>(64 * 64)};
    for (uint32_t& word : picture.words) word = dice.next() << 16 ^ dice.next();
    const auto noise = patterns::in_memory(picture, PixelFormat::kRgba8);
    FrameStatistics found;
    engine.process(noise.view(), found);
    EXPECT_EQ(found.schemes[0].palette_bits, 0u);
    EXPECT_EQ(found.schemes[0].payload_bits, 64u * 2048);
  }
}

TEST(Lcc, DependsOnTheFramesOfItsHistoryAlone) {
  const std::vector<SchemeSpec> schemes{parsed("lcc"), parsed("lcc:fvc=16,period=3")};
  SurfaceEngine whole(schemes, ModelOptions{}), part(schemes, ModelOptions{});
  std::vector<patterns::MemorySurface> frames;
  for (uint32_t i = 0; i < 9; ++i)
    frames.push_back(patterns::in_memory(waves(128, 5 * i), PixelFormat::kRgba8));
  FrameStatistics expected, found;
  for (uint32_t i = 0; i < 9; ++i) whole.process(frames[i].view(), expected);
  for (const uint64_t before : part.history(8, PixelFormat::kRgba8)) {
    part.seek(before);
    part.process(frames[before].view(), found);
  }
  part.seek(8);
  part.process(frames[8].view(), found);
  for (size_t i = 0; i < schemes.size(); ++i) {
    EXPECT_EQ(found.schemes[i].payload_bits, expected.schemes[i].payload_bits);
    EXPECT_EQ(found.schemes[i].palette_bits, expected.schemes[i].palette_bits);
  }
}

TEST(Lcc, BehindTablesThatAreRefusedBlocksAreRefusedToo) {
  const auto decoder = find_scheme("lcc")->make_decoder(parsed("lcc"), traits(PixelFormat::kRgba8), {});
  const std::vector<uint8_t> zeros(4096), marks{(64 + 1) << 1};
  Block block;
  const auto decodes = [&] {
    BitReader csb(marks), payload(zeros);
    return decoder->decode(csb, payload, block);
  };
  EXPECT_FALSE(decodes());
  BitReader lengths(zeros);  // no code has a length of 0
  EXPECT_FALSE(decoder->begin_frame(lengths, LccLengths::kTableBits, 7));
  EXPECT_FALSE(decodes());
  BitReader nothing(zeros);
  EXPECT_FALSE(decoder->begin_frame(nothing, 5, 7));
  EXPECT_FALSE(decodes());
}

TEST(Lcc, RefusesAPaletteOverFourKibibytes) {
  EXPECT_TRUE(parse_scheme("lcc:fvc=512"));
  const auto refused = parse_scheme("lcc:fvc=1024");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().text.find("512"), std::string::npos);
}

TEST(LccKernels, PlanesAreTheSameOnEveryTarget) {
  patterns::Dice dice(11);
  for (uint32_t round = 0; round < 600 && !HasFatalFailure(); ++round) {
    LccPlane<uint32_t> pixels = patterns::draw_block(1 + dice.below(64), 1 + dice.below(8), dice);
    if (round % 3 == 0)
      for (uint32_t& pixel : pixels) pixel = pixel % 8 * 0x01010101u + 0x7F7F7F7Fu;
    LccPlanes plain{};
    kPlainLccKernels.find_planes(pixels, plain);
    patterns::on_every_target([&] {
      LccPlanes other{};
      lcc_kernels().find_planes(pixels, other);
      ASSERT_EQ(other.token, plain.token);
      ASSERT_EQ(other.shape, plain.shape);
      ASSERT_EQ(other.residual, plain.residual);
      ASSERT_EQ(other.estimate, plain.estimate);
      ASSERT_EQ(other.estimates, plain.estimates);
      ASSERT_EQ(other.folded, plain.folded);
      ASSERT_EQ(other.symbol, plain.symbol);
      ASSERT_EQ(other.rest_bits, plain.rest_bits);
    });
  }
}
