// Palette files: what is read, what is refused, and how the scheme uses them.
#include "palette/palette_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "block_harness.h"

using namespace harness;

namespace {

/// A file that lasts as long as the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content) {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("tilepress-palette-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ".txt");
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

std::string fault(const std::string& content) {
  const TemporaryFile file(content);
  const auto spec = parse_scheme("palette:file=" + file.path());
  EXPECT_FALSE(spec.has_value()) << content;
  if (spec) return {};
  EXPECT_EQ(spec.error().kind, ErrorKind::kFile);
  const std::string error = spec.error().text;
  EXPECT_NE(error.find("file=" + file.path() + ": "), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  return error;
}

}  // namespace

TEST(PaletteFile, ReadsColoursWithAndWithoutAlpha) {
  const TemporaryFile file("#102030\n\n  #AbCdEf80\r\n#000000");
  const auto colors = read_palette_file(file.path());
  ASSERT_TRUE(colors.has_value()) << colors.error().text;
  EXPECT_EQ(*colors, (std::vector<uint32_t>{0xFF302010, 0x80EFCDAB, 0xFF000000}));
}

TEST(PaletteFile, ErrorsNameFileLineAndFault) {
  EXPECT_NE(fault("#102030\nred\n").find("line 2: 'red' is not #RRGGBB or #RRGGBBAA"), std::string::npos);
  EXPECT_NE(fault("#10203\n").find("line 1: '#10203'"), std::string::npos);
  EXPECT_NE(fault("#10203g\n").find("line 1"), std::string::npos);
  EXPECT_NE(fault("").find("holds no colours"), std::string::npos);
  EXPECT_NE(fault("\n\n").find("holds no colours"), std::string::npos);
  std::string many;
  for (int i = 0; i < 1025; ++i) many += "#102030\n";
  EXPECT_NE(fault(many).find("line 1025: more than 1024 colours"), std::string::npos);
  EXPECT_NE(fault(std::string(70000, '\n')).find("larger than 64 KiB"), std::string::npos);
  EXPECT_NE(fault(std::string("\x01\x02\x00\xff", 4)).find("line 1: '?"), std::string::npos);
  const auto nowhere = parse_scheme("palette:file=/nowhere/at/all");
  ASSERT_FALSE(nowhere.has_value());
  EXPECT_NE(nowhere.error().text.find("file=/nowhere/at/all: no such file"), std::string::npos);
  EXPECT_FALSE(parse_scheme("palette:file=/").has_value());
}

TEST(PaletteFile, IsNotOpenedByWhoOnlyDecodes) {
  const auto spec = parse_scheme("palette:file=/nowhere/at/all", SchemeFiles::kLeave);
  ASSERT_TRUE(spec.has_value()) << spec.error().text;
  EXPECT_TRUE(spec->list("file").empty());
  EXPECT_FALSE(parse_scheme("palette:file=", SchemeFiles::kLeave).has_value());
  EXPECT_FALSE(parse_scheme("palette:file=x,entries=4", SchemeFiles::kLeave).has_value());
}

TEST(PaletteFile, GoesWithNoOtherSource) {
  const TemporaryFile file("#102030\n");
  for (const char* other : {",from=first", ",entries=4"}) {
    const auto spec = parse_scheme("palette:file=" + file.path() + other);
    ASSERT_FALSE(spec.has_value());
    EXPECT_NE(spec.error().text.find("do not go with file"), std::string::npos);
  }
}

TEST(PaletteFile, IsInForceFromTheFirstFrame) {
  const TemporaryFile file("#102030\n#405060\n#708090\n");
  const BlockHarness scheme("palette:file=" + file.path(), nullptr);
  EXPECT_EQ(scheme.tables_written(), 4u * 33);  // three colours take four slots
  EXPECT_EQ(scheme.measure(solid(0xFF302010)), 64u * 2);
  EXPECT_EQ(scheme.measure(solid(0xFF302011)), 2048u);
  EXPECT_TRUE(scheme.returns(solid(0xFF908070)));
  EXPECT_TRUE(scheme.returns(solid(0xFF302011)));
}

TEST(PaletteFile, BringsColoursToTheSurfacesFormatOnce) {
  // #FF0000 and #FD0000 are both 31 of 31 in RGB565: one colour, no index bits.
  const TemporaryFile file("#FF0000\n#FD0000\n");
  const BlockHarness scheme("palette:file=" + file.path(), nullptr, PixelFormat::kRgb565);
  EXPECT_EQ(scheme.tables_written(), 1u * 17);
  EXPECT_EQ(scheme.measure(solid(31u << 11)), 0u);
  EXPECT_TRUE(scheme.returns(solid(31u << 11)));
  // Ten bits of 0x80: 128 · 1023 / 255 = 513.5; two of alpha 255: 3.
  const TemporaryFile gray("#800000\n");
  EXPECT_EQ(BlockHarness("palette:file=" + gray.path(), nullptr, PixelFormat::kRgb10a2)
                .measure(solid(514 | 3u << 30)),
            0u);
  // A surface without alpha has 255, whatever the file says.
  const TemporaryFile clear("#01020300\n");
  EXPECT_EQ(
      BlockHarness("palette:file=" + clear.path(), nullptr, PixelFormat::kRgbx8).measure(solid(0xFF030201)),
      0u);
}
