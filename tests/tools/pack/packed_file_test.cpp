// A packed file gives back what was put in, and says so in one line when it is not whole.
#include <gtest/gtest.h>
#include <zlib.h>

#include <sstream>

#include "frames/packed_reader.h"
#include "frames/packed_writer.h"
#include "surface_samples.h"
#include "tilepress/surface_reader.h"

namespace tilepress {
namespace {

std::string packed(const std::vector<CompressedSurface>& surfaces) {
  std::ostringstream out;
  PackedFileWriter writer(out);
  for (const CompressedSurface& surface : surfaces) EXPECT_TRUE(writer.append(surface));
  EXPECT_TRUE(writer.finish());
  return out.str();
}

/// Opens and reads everything, as unpack does. Empty if all is well; else the line.
std::string complaint(const std::string& bytes) {
  std::istringstream in(bytes);
  PackedFileReader reader;
  CompressedSurface surface;
  auto done = reader.open(in);
  for (uint32_t i = 0; done && i < reader.count(); ++i) done = reader.read(i, surface);
  if (done) return {};
  return done.error().text.empty() ? "refused without a word" : done.error().text;
}

std::vector<CompressedSurface> small_sequence(const std::string& scheme) {
  const auto first = mixed_frame(17, 9, PixelFormat::kRgba8, 1);
  const auto second = mixed_frame(17, 9, PixelFormat::kRgba8, 2);
  return {compress(scheme, {first}, {}), compress(scheme, {first, second}, {})};
}

TEST(PackedFile, GivesEverySurfaceBackAsItWas) {
  for (const char* scheme : {"dcp", "adcp", "vdcp:fvc=128", "huffdcp", "hdcp", "ras:ycocg=1", "red"})
    for (const PixelFormat format :
         {PixelFormat::kRgba8, PixelFormat::kRgbx8, PixelFormat::kRgb565, PixelFormat::kRgb10a2})
      for (const auto& [width, height] : {std::pair{1u, 1u}, {67u, 129u}}) {
        const auto frame = mixed_frame(width, height, format, 3);
        const CompressedSurface before =
            compress(scheme, {frame, frame}, {.tile_side = 16, .burst_bits = 256});
        std::istringstream in(packed({before, before}));
        PackedFileReader reader;
        const auto opened = reader.open(in);
        ASSERT_TRUE(opened) << opened.error().text;
        ASSERT_EQ(reader.count(), 2u);
        CompressedSurface after;
        const auto read = reader.read(1, after);
        ASSERT_TRUE(read) << read.error().text;
        EXPECT_EQ(after.scheme.text, scheme);
        EXPECT_EQ(after.format, format);
        EXPECT_EQ(after.width, width);
        EXPECT_EQ(after.height, height);
        EXPECT_EQ(after.ordinal, 1u);
        EXPECT_EQ(after.tile_side, 16u);
        EXPECT_EQ(after.burst_bits, 256u);
        EXPECT_EQ(after.csb_bits, before.csb_bits);
        EXPECT_EQ(after.table_bits, before.table_bits);
        EXPECT_EQ(after.payload, before.payload);
        EXPECT_EQ(after.csb, before.csb);
        EXPECT_EQ(after.tables, before.tables);
        EXPECT_EQ(after.block_bits, before.block_bits);
        SurfaceReader pixels;
        std::vector<uint32_t> words;
        ASSERT_TRUE(pixels.open(after, {}));
        ASSERT_TRUE(pixels.read_rect({0, 0, width, height}, words));
        EXPECT_EQ(words, frame.words);
      }
}

TEST(PackedFile, IsRefusedAtEveryLengthButItsOwn) {
  const std::string whole = packed(small_sequence("vdcp:fvc=8"));
  ASSERT_EQ(complaint(whole), "");
  for (size_t length = 0; length < whole.size(); ++length) {
    const std::string line = complaint(whole.substr(0, length));
    EXPECT_NE(line, "") << "cut to " << length << " of " << whole.size();
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
  EXPECT_EQ(complaint(whole + "x"), "1 bytes too many behind the last surface");
}

TEST(PackedFile, IsRefusedWithAnyBitFlipped) {
  std::string bytes = packed({small_sequence("vdcp:fvc=8").back()});
  for (size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
    EXPECT_NE(complaint(bytes), "") << "bit " << bit;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
  }
  EXPECT_EQ(complaint(bytes), "");
}

TEST(PackedFile, SaysWhatIsWrong) {
  const std::string whole = packed(small_sequence("vdcp:fvc=8"));
  EXPECT_EQ(complaint(""), "empty, not a packed file");
  EXPECT_EQ(complaint("\x89PNG\r\n\x1a\n and so on, for a while"), "not a packed file");
  EXPECT_EQ(complaint(whole.substr(0, 15)), "cut short in the file header");
  EXPECT_EQ(complaint(whole.substr(0, 20)), "cut short: 0 of 2 surfaces");
  EXPECT_EQ(complaint(whole.substr(0, 30)), "surface 0: cut short in a header");
  EXPECT_EQ(complaint(whole.substr(0, whole.size() - 1)), "surface 1: cut short in a surface");
}

/// Puts a number into a surface header of the first surface and its checksum right again.
std::string with_field(std::string bytes, size_t offset, uint64_t value, uint32_t size, size_t spec_bytes) {
  constexpr size_t kHeader = 20, kFields = 56;
  for (uint32_t i = 0; i < size; ++i) bytes[kHeader + offset + i] = static_cast<char>(value >> (8 * i));
  const size_t covered = kFields + spec_bytes;
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data() + kHeader), covered);
  for (uint32_t i = 0; i < 4; ++i) bytes[kHeader + covered + i] = static_cast<char>(crc >> (8 * i));
  return bytes;
}

TEST(PackedFile, HeadersThatClaimTheImpossibleAreRefusedBeforeAnythingIsAllocated) {
  const std::string scheme = "vdcp:fvc=8";
  const std::string whole = packed({small_sequence(scheme).back()});
  const auto line = [&](size_t offset, uint64_t value, uint32_t size) {
    return complaint(with_field(whole, offset, value, size, scheme.size()));
  };
  EXPECT_EQ(line(12, 17, 4), "") << "the width it has";
  EXPECT_EQ(line(12, 0, 4), "surface 0: a surface of 0x9 cannot be");
  EXPECT_EQ(line(12, 0xFFFFFFFF, 4), "surface 0: a surface of 4294967295x9 cannot be");
  EXPECT_EQ(line(12, 65535, 4), "surface 0: cut short in a surface");
  EXPECT_EQ(line(20, 99, 4), "surface 0: unknown pixel format 99");
  EXPECT_EQ(line(20, 4, 4), "surface 0: unknown pixel format 4");
  EXPECT_EQ(line(24, 12, 4), "surface 0: render tiles of 12 pixels cannot be");
  EXPECT_EQ(line(28, 0, 4), "surface 0: bursts of 0 bits cannot be");
  EXPECT_EQ(line(32, 0xFFFFFFFF, 4), "surface 0: CSB entries of 4294967295 bits cannot be");
  EXPECT_EQ(line(56, '\n', 1), "surface 0: a scheme specification that is no text");
  EXPECT_EQ(line(56, 0x1B, 1), "surface 0: a scheme specification that is no text");
  EXPECT_NE(line(36, ~uint64_t{0}, 8), "");
  EXPECT_NE(line(44, ~uint64_t{0}, 8), "");
  EXPECT_NE(line(44, ~uint64_t{0} - 100, 8), "");
}

}  // namespace
}  // namespace tilepress
