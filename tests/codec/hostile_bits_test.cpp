// Hostile bits: every decoder survives random, altered and truncated input with a status.
#include <gtest/gtest.h>

#include "block_harness.h"
#include "scheme_texts.h"

using namespace harness;

namespace {

const PixelFormat kFormats[] = {PixelFormat::kRgba8, PixelFormat::kRgb565, PixelFormat::kRgb10a2};

std::vector<uint8_t> random_bytes(patterns::Dice& dice, size_t size) {
  // Mostly noise; at times mostly zeros or ones, which reach the ends of unary codes and of tables.
  const uint32_t kind = dice.below(4);
  std::vector<uint8_t> bytes(size);
  for (uint8_t& byte : bytes) {
    const auto a = static_cast<uint8_t>(dice.next()), b = static_cast<uint8_t>(dice.next());
    byte = kind == 0 ? a & b : kind == 1 ? a | b : a;
  }
  return bytes;
}

uint32_t entries_of(const char* text) {
  return reference::number_of(parsed(text), "fvc", 64);
}

Ccd some_dictionary(uint32_t entries, PixelFormat format, patterns::Dice& dice) {
  std::vector<uint32_t> colors;
  for (uint32_t i = 0; i < std::min(entries, 40u); ++i)
    colors.push_back(patterns::fit(dice.next() << 8 | i, format));
  return dictionary(entries, colors);
}

Block some_block(const Ccd& ccd, PixelFormat format, patterns::Dice& dice) {
  Block block;
  for (uint32_t& word : block.pixels)
    word = dice.below(9) == 0 ? patterns::fit(dice.next(), format)
                              : ccd.colors[dice.below(static_cast<uint32_t>(ccd.colors.size()))];
  return block;
}

}  // namespace

TEST(HostileBits, RandomTablesAreTakenOrRefused) {
  patterns::Dice dice(1);
  for (const char* text : kSchemeTexts)
    for (const PixelFormat format : kFormats) {
      BlockHarness scheme(text, nullptr, format);
      for (int round = 0; round < 200; ++round) {
        const auto bytes = random_bytes(dice, dice.below(200));
        const uint64_t bits = dice.below(2) ? bytes.size() * 8 : dice.below(70000);
        const uint32_t csb_bits = dice.below(2) ? scheme.encoder().csb_bits() : dice.below(100);
        BitReader tables(bytes);
        const bool taken = scheme.decoder().begin_frame(tables, bits, csb_bits);
        if (taken) {
          EXPECT_FALSE(tables.overran()) << text;
        }
      }
    }
}

TEST(HostileBits, BehindTablesThatAreRefusedBlocksAreRefusedToo) {
  // Not what the decoder holds of the frame before: after a refusal its parts need not fit together.
  for (const char* name : {"huffdcp", "fbc"}) {
    SCOPED_TRACE(name);
    const auto info = find_scheme(name);
    const auto decoder = info->make_decoder(parsed(name), traits(PixelFormat::kRgba8), {});
    std::vector<uint8_t> good(64 * 39 / 8 + 1), bad(10);
    BitWriter good_tables(good), bad_tables(bad);
    for (uint32_t i = 0; i < 64; ++i) good_tables.put(uint64_t{1} << 32 | i, 33);
    for (uint32_t i = 0; i < 64; ++i) good_tables.put(6, 6);
    bad_tables.put(uint64_t{1} << 32, 33);  // a colour,
    bad_tables.put(0, 33);
    bad_tables.put(0, 12);  // but no code for it
    good_tables.flush();
    bad_tables.flush();
    const std::vector<uint8_t> ones(256, 0xFF);
    Block block;
    BitReader good_reader(good);
    ASSERT_TRUE(decoder->begin_frame(good_reader, 64 * 39, 16));
    BitReader csb(ones), payload(ones);
    EXPECT_TRUE(decoder->decode(csb, payload, block));
    EXPECT_EQ(block, solid(63));
    BitReader bad_reader(bad);
    ASSERT_FALSE(decoder->begin_frame(bad_reader, 2 * 39, 16));
    BitReader next_csb(ones), next_payload(ones);
    EXPECT_FALSE(decoder->decode(next_csb, next_payload, block));
  }
}

TEST(HostileBits, AFrameOfRasIsReadBehindOneThatWasOff) {
  const auto info = find_scheme("hdcp");
  const auto decoder = info->make_decoder(parsed("hdcp"), traits(PixelFormat::kRgba8), {});
  const BlockHarness ras("ras", nullptr);
  const auto bits = ras.encode(solid(0x12345678));
  BitReader none(std::span<const uint8_t>{}), tables(std::span<const uint8_t>{});
  EXPECT_TRUE(decoder->begin_frame(none, 0, 0));  // no encoder of HDCP leaves the CSB out
  EXPECT_TRUE(decoder->begin_frame(tables, 0, 2));
  BitReader csb = bits.read_csb(), payload = bits.read_payload();
  Block block;
  ASSERT_TRUE(decoder->decode(csb, payload, block));
  EXPECT_EQ(block, solid(0x12345678));
}

TEST(HostileBits, ADictionaryLargerThanTheFvcIsRefused) {
  const auto info = find_scheme("dcp");
  const auto decoder = info->make_decoder(parsed("dcp:fvc=4"), traits(PixelFormat::kRgba8), {});
  std::vector<uint8_t> tables(8 * 33 / 8);
  BitWriter writer(tables);
  for (uint32_t i = 0; i < 8; ++i) writer.put(uint64_t{1} << 32 | i, 33);
  writer.flush();
  BitReader eight(tables), four(tables);
  EXPECT_FALSE(decoder->begin_frame(eight, 8 * 33, 16));
  EXPECT_TRUE(decoder->begin_frame(four, 4 * 33, 16));
}

TEST(HostileBits, RandomBlocksAreDecodedOrRefused) {
  patterns::Dice dice(2);
  for (const char* text : kSchemeTexts)
    for (const PixelFormat format : kFormats) {
      if (!find_scheme(parsed(text).name)->supports(format)) continue;
      const Ccd ccd = some_dictionary(entries_of(text), format, dice);
      const BlockHarness scheme(text, &ccd, format);
      ASSERT_TRUE(scheme.tables_accepted()) << text;
      for (int round = 0; round < 300; ++round) {
        Encoded bits;
        bits.payload = random_bytes(dice, dice.below(280));
        bits.csb = random_bytes(dice, dice.below(12));
        bits.payload_bits = static_cast<uint32_t>(bits.payload.size() * 8);
        bits.csb_bits = static_cast<uint32_t>(bits.csb.size() * 8);
        Block out{};
        if (!scheme.decode(bits, out)) continue;
        for (const uint32_t word : out.pixels)
          EXPECT_EQ(uint64_t{word} >> traits(format).pixel_bits, 0u) << text << ": no such pixel";
      }
    }
}

TEST(HostileBits, AnAlteredBitGivesAnotherBlockOrNone) {
  patterns::Dice dice(3);
  for (const char* text : kSchemeTexts) {
    const Ccd ccd = some_dictionary(entries_of(text), PixelFormat::kRgba8, dice);
    const BlockHarness scheme(text, &ccd);
    for (int round = 0; round < 100; ++round) {
      Encoded bits = scheme.encode(some_block(ccd, PixelFormat::kRgba8, dice));
      auto& bytes = dice.below(3) == 0 || bits.payload_bits == 0 ? bits.csb : bits.payload;
      const uint32_t length = &bytes == &bits.csb ? bits.csb_bits : bits.payload_bits;
      const uint32_t at = dice.below(length);
      bytes[at / 8] ^= static_cast<uint8_t>(0x80 >> at % 8);
      Block out{};
      scheme.decode(bits, out);
    }
  }
}

TEST(HostileBits, EveryTruncationOfABlockIsRefused) {
  patterns::Dice dice(4);
  for (const char* text : kSchemeTexts) {
    const Ccd ccd = some_dictionary(entries_of(text), PixelFormat::kRgba8, dice);
    const BlockHarness scheme(text, &ccd);
    const Encoded whole = scheme.encode(some_block(ccd, PixelFormat::kRgba8, dice));
    Block out{};
    ASSERT_TRUE(scheme.decode(whole, out)) << text;
    for (uint32_t length = 0; length < whole.payload_bits; ++length) {
      Encoded cut = whole;
      cut.payload_bits = length;
      EXPECT_FALSE(scheme.decode(cut, out)) << text << " cut to " << length << " of " << whole.payload_bits;
    }
    for (uint32_t length = 0; length < whole.csb_bits; ++length) {
      Encoded cut = whole;
      cut.csb_bits = length;
      EXPECT_FALSE(scheme.decode(cut, out)) << text << " CSB cut to " << length;
    }
  }
}

TEST(HostileBits, EveryTruncationOfTheTablesIsRefused) {
  patterns::Dice dice(5);
  for (const char* text : {"dcp", "adcp", "vdcp", "huffdcp", "hdcp", "freqvals"}) {
    const Ccd ccd = some_dictionary(64, PixelFormat::kRgba8, dice);
    BlockHarness scheme(text, &ccd);
    const uint64_t whole = scheme.tables_written();
    std::vector<uint8_t> bytes(whole / 8 + 1);
    BitWriter writer(bytes);
    scheme.encoder().write_tables(writer);
    writer.flush();
    for (uint64_t length = 0; length < whole; ++length) {
      BitReader tables(bytes, length);
      EXPECT_FALSE(scheme.decoder().begin_frame(tables, whole, scheme.encoder().csb_bits()))
          << text << length;
    }
  }
}
