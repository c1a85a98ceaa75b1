// Bit writer and reader: order, limits, truncation.
#include "tilepress/bit_io.h"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <vector>

using tilepress::BitReader;
using tilepress::BitWriter;

TEST(BitIo, HighestBitGoesFirstAndTheLastByteIsFilledWithZeros) {
  std::array<uint8_t, 2> bytes{0xFF, 0xFF};
  BitWriter writer(bytes);
  writer.put(0b101, 3);
  writer.put(0, 0);
  writer.put(0b11, 2);
  writer.put(0b011011, 6);
  writer.flush();
  EXPECT_EQ(bytes[0], 0b10111011);  // 101 11 011
  EXPECT_EQ(bytes[1], 0b01100000);  // 011 and five bits of filling
  EXPECT_EQ(writer.bit_count(), 11u);
  EXPECT_FALSE(writer.overflowed());
}

TEST(BitIo, TheLargestCallFitsBesideSevenPendingBits) {
  std::array<uint8_t, 8> bytes{};
  const uint64_t value = (uint64_t{1} << 57) - 2;
  BitWriter writer(bytes);
  writer.put(0b1010101, 7);
  writer.put(value, tilepress::kMaxBitsPerCall);
  writer.flush();
  BitReader reader(bytes);
  EXPECT_EQ(reader.get(7), 0b1010101u);
  EXPECT_EQ(reader.get(57), value);
  EXPECT_FALSE(reader.overran());
}

TEST(BitIo, SixtyFourBitsComeBackFromAnyPlace) {
  const uint64_t value = 0x0123456789ABCDEFu;
  for (uint32_t before = 0; before < 20; ++before)
    for (uint32_t room : {0u, 1u, 8u}) {  // bytes behind
      std::vector<uint8_t> bytes((before + 64 + 7) / 8 + room);
      BitWriter writer(bytes);
      writer.put((uint64_t{1} << before) - 1, before);
      writer.put64(value);
      writer.flush();
      BitReader reader(bytes, before + 64);
      EXPECT_EQ(reader.get(before), (uint64_t{1} << before) - 1);
      EXPECT_EQ(reader.get64(), value) << before << ", " << room;
      EXPECT_EQ(reader.position(), before + 64);
      EXPECT_FALSE(reader.overran());
      BitReader short_reader(bytes, before + 40);  // zeros past the end
      short_reader.skip(before);
      EXPECT_EQ(short_reader.get64(), value >> 24 << 24);
      EXPECT_TRUE(short_reader.overran());
    }
}

TEST(BitIo, BitsWrittenByOthersAreCountedAndGoOn) {
  std::array<uint8_t, 4> bytes{};
  BitWriter writer(bytes);
  EXPECT_EQ(writer.at_byte(5), nullptr);
  uint8_t* out = writer.at_byte(4);
  ASSERT_EQ(out, bytes.data());
  out[0] = 0xAB;
  out[1] = 0xC0;
  writer.wrote(12);
  EXPECT_EQ(writer.bit_count(), 12u);
  EXPECT_EQ(writer.at_byte(1), nullptr);
  writer.put(0xDE, 8);
  writer.flush();
  EXPECT_EQ(bytes, (std::array<uint8_t, 4>{0xAB, 0xCD, 0xE0, 0}));
}

TEST(BitIo, BytesAreThereOnlyWhereAllOfThemAre) {
  const std::array<uint8_t, 4> bytes{1, 2, 3, 4};
  BitReader reader(bytes, 30);
  EXPECT_EQ(reader.at_byte(3), bytes.data());
  EXPECT_EQ(reader.at_byte(4), nullptr);  // two bits short
  reader.skip(8);
  EXPECT_EQ(reader.at_byte(2), bytes.data() + 1);
  EXPECT_EQ(reader.at_byte(3), nullptr);
  reader.skip(1);
  EXPECT_EQ(reader.at_byte(1), nullptr);
  reader.skip(31);
  EXPECT_EQ(reader.at_byte(0), nullptr);  // behind the end
}

TEST(BitIo, UnaryOfAnyLengthComesBack) {
  for (uint32_t count : {0u, 1u, 31u, 32u, 33u, 64u, 100u}) {
    std::array<uint8_t, 16> bytes{};
    BitWriter writer(bytes);
    for (uint32_t i = 0; i < count; ++i) writer.put(1, 1);
    writer.put(0, 1);
    writer.flush();
    EXPECT_EQ(writer.bit_count(), count + 1);
    BitReader reader(bytes, writer.bit_count());
    EXPECT_EQ(reader.get_unary(100), count);
    EXPECT_EQ(reader.position(), count + 1);
  }
}

TEST(BitIo, UnaryGivesUpPastItsLimit) {
  const std::array<uint8_t, 4> ones{0xFF, 0xFF, 0xFF, 0xFF};
  BitReader reader(ones);
  EXPECT_GT(reader.get_unary(5), 5u);
}

TEST(BitIo, PadToFillsWithZerosUpToTheGivenLength) {
  std::array<uint8_t, 16> bytes;
  bytes.fill(0xFF);
  BitWriter writer(bytes);
  writer.put(1, 1);
  writer.pad_to(100);
  writer.flush();
  EXPECT_EQ(writer.bit_count(), 100u);
  EXPECT_EQ(bytes[0], 0x80);
  for (size_t i = 1; i < 13; ++i) EXPECT_EQ(bytes[i], 0) << i;
}

TEST(BitIo, AWriterCountsWhatDoesNotFitAndWritesNothingThere) {
  std::array<uint8_t, 3> bytes{0, 0, 0xA5};
  BitWriter writer(std::span<uint8_t>(bytes).first(2));
  writer.put(0xFFFF, 16);
  EXPECT_FALSE(writer.overflowed());
  writer.put(1, 1);
  writer.flush();
  EXPECT_TRUE(writer.overflowed());
  EXPECT_EQ(writer.bit_count(), 17u);
  EXPECT_EQ(bytes[2], 0xA5);
}

TEST(BitIo, PastTheEndAReaderGivesZerosAndRemembers) {
  const std::array<uint8_t, 1> bytes{0xFF};
  BitReader reader(bytes);
  EXPECT_EQ(reader.get(4), 0xFu);
  EXPECT_EQ(reader.get(8), 0xF0u);  // four bits of the buffer, four beyond
  EXPECT_TRUE(reader.overran());
  EXPECT_EQ(reader.get(57), 0u);
  EXPECT_EQ(reader.get_unary(9), 0u);
}

TEST(BitIo, AnEndInsideAByteHidesTheBitsBehindIt) {
  const std::array<uint8_t, 1> bytes{0xFF};
  BitReader reader(bytes, 3);
  EXPECT_EQ(reader.get(8), 0b11100000u);
  EXPECT_TRUE(reader.overran());
}

TEST(BitIo, ABitCountBeyondTheBufferEndsAtTheBuffer) {
  const std::array<uint8_t, 1> bytes{0xFF};
  BitReader reader(bytes, 1000);
  reader.skip(8);
  EXPECT_FALSE(reader.overran());
  EXPECT_EQ(reader.get(1), 0u);
  EXPECT_TRUE(reader.overran());
}

TEST(BitIo, SkippingPastTheEndIsRemembered) {
  const std::vector<uint8_t> bytes(4, 0xFF);
  BitReader reader(bytes);
  reader.skip(33);
  EXPECT_TRUE(reader.overran());
  EXPECT_EQ(reader.get(8), 0u);
}
