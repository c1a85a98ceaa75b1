// Toy scheme: a scheme that registers itself at run time takes part in everything.
#include "toy_scheme.h"

#include <gtest/gtest.h>

#include "surface_patterns.h"
#include "tilepress/statistics_rows.h"
#include "tilepress/surface_engine.h"
#include "tilepress/surface_reader.h"

using namespace tilepress;

namespace {

/// Registers once per program.
void register_toy() {
  static const bool registered = bool(register_scheme(toy::kInfo));
  ASSERT_TRUE(registered);
}

/// 16×8 pixels: eight solid rows on the left; on the right seven, and one with two colours.
reference::Picture two_blocks() {
  reference::Picture picture{16, 8, std::vector<uint32_t>(128)};
  for (uint32_t i = 0; i < 128; ++i) picture.words[i] = i / 16 * 0x01020304u;
  picture.words[15] = 5;
  return picture;
}

}  // namespace

TEST(ToyScheme, BringsItsKeysWithItsRanges) {
  register_toy();
  EXPECT_EQ(parse_scheme("toy")->number("rows"), 8u);
  EXPECT_EQ(parse_scheme("toy:rows=3")->number("rows"), 3u);
  EXPECT_EQ(parse_scheme("toy:rows=9").error().text,
            "scheme 'toy:rows=9': rows=9: must be a whole number from 1 to 8");
  EXPECT_EQ(parse_scheme("toy:fvc=64").error().text, "scheme 'toy:fvc=64': unknown key 'fvc' (toy takes rows)");
}

TEST(ToyScheme, RunsBesideOtherSchemesAndIsVerified) {
  register_toy();
  ModelOptions options;
  options.verify = true;
  SurfaceEngine engine({*parse_scheme("vdcp"), *parse_scheme("toy"), *parse_scheme("toy:rows=2")}, options);
  FrameStatistics frame;
  std::vector<CompressedSurface> surfaces(3);
  const auto memory = patterns::in_memory(two_blocks(), PixelFormat::kRgba8);
  engine.process(memory.view(), frame, surfaces);
  EXPECT_EQ(frame.schemes[1].payload_bits, 32u * (8 + 7 + 8));
  EXPECT_EQ(frame.schemes[1].own[0], 15u);
  EXPECT_EQ(frame.schemes[2].payload_bits, 32u * (2 + 48 + 8 + 1 + 48));
  EXPECT_EQ(frame.schemes[1].checked_blocks, 2u);
  EXPECT_EQ(frame.schemes[1].mismatched_blocks + frame.schemes[2].mismatched_blocks, 0u);
  SurfaceReader reader;
  ASSERT_TRUE(reader.open(surfaces[1], {}));
  std::vector<uint32_t> words;
  ASSERT_TRUE(reader.read_rect({0, 0, 16, 8}, words));
  EXPECT_EQ(words, two_blocks().words);
}

TEST(ToyScheme, HasAColumnThatIsZeroForOtherSchemes) {
  register_toy();
  EXPECT_NE(schemes_csv_header().find(",vdcp_blocks,ras_blocks,toy_rows,checked_blocks,"), std::string::npos);
  FrameStatistics frame;
  frame.schemes.resize(2);
  frame.schemes[0].own = {3, 4, 2};
  frame.schemes[1].own = {15};
  std::string rows;
  append_schemes_rows(frame, {"hdcp", "toy:rows=8"}, rows);
  EXPECT_EQ(rows,
            "0,0,hdcp,0,0,0,0,0,0,0,0,0,0,3,4,0,0,0,0,,,2,,,,\n"
            "0,0,toy:rows=8,0,0,0,0,0,0,0,0,0,0,0,0,15,0,0,0,,,0,,,,\n");
}

TEST(ToyScheme, IsRefusedASecondTimeAndUnderANameThatNoOptionCanHold) {
  register_toy();
  EXPECT_EQ(register_scheme(toy::kInfo).error().text, "scheme 'toy': there is a scheme of this name already");
  SchemeInfo other = toy::kInfo;
  other.name = "a:b";
  EXPECT_EQ(register_scheme(other).error().text, "scheme 'a:b': not a name for a scheme");
}
