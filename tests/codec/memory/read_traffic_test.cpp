// Bursts that a reader fetches equal numbers derived by hand.
#include <gtest/gtest.h>

#include "surface_samples.h"
#include "tilepress/surface_reader.h"

namespace tilepress {
namespace {

SampleFrame solid_frame(uint32_t width, uint32_t height, uint32_t word) {
  SampleFrame frame{
      width, height, PixelFormat::kRgba8, std::vector<uint32_t>(size_t{width} * height, word), {}};
  frame.pack();
  return frame;
}

ReadTraffic traffic_of(const CompressedSurface& surface, const ReadOptions& options, const PixelRect& rect) {
  SurfaceReader reader;
  std::vector<uint32_t> words;
  EXPECT_TRUE(reader.open(surface, options));
  EXPECT_TRUE(reader.read_rect(rect, words));
  return reader.traffic();
}

// 64×32 pixels are 8×4 blocks. DCP on one colour: the second frame's block is 16 sub-blocks of 4 indices of
// 6 bits = 384 bits = 3 bursts of 128; its CSB is 16 bits, so 32 blocks have 512 bits = 4 bursts; the rCCD is
// 64 × 33 = 2112 bits = 16.5, so 17 bursts. A raw block is 2048 bits = 16 bursts.
TEST(ReadTraffic, AWholeSolidSurfaceOfDcp) {
  const auto frame = solid_frame(64, 32, 0xFF336699);
  const auto traffic = traffic_of(compress("dcp", {frame, frame}, {}), {}, {0, 0, 64, 32});
  EXPECT_EQ(traffic.blocks, 32u);
  EXPECT_EQ(traffic.payload_bursts, 32u * 3);
  EXPECT_EQ(traffic.csb_bursts, 4u);
  EXPECT_EQ(traffic.table_bursts, 17u);
  EXPECT_EQ(traffic.raw_bursts, 32u * 16);
  EXPECT_EQ(traffic.csb_lookups, 32u);
  EXPECT_EQ(traffic.csb_misses, 1u) << "4 bursts are one line";
  EXPECT_EQ(traffic.moved_bursts(), 96u + 4 + 17);
}

// VDCP: the only colour has index 0, so blocks have no payload at all; CSB 48 bits a block, 8 blocks 384
// bits.
TEST(ReadTraffic, ASolidSurfaceOfVdcpHasNoPayloadToFetch) {
  const auto frame = solid_frame(64, 8, 0xFF336699);
  const auto traffic = traffic_of(compress("vdcp", {frame, frame}, {}), {}, {0, 0, 64, 8});
  EXPECT_EQ(traffic.payload_bursts, 0u);
  EXPECT_EQ(traffic.csb_bursts, 3u);
  EXPECT_EQ(traffic.raw_bursts, 8u * 16);
}

// Pixels (7,7)…(8,8) touch four blocks: 0, 1, 8 and 9 of 8 columns.
TEST(ReadTraffic, ARectangleFetchesTheBlocksItTouches) {
  const auto frame = solid_frame(64, 32, 0xFF336699);
  const auto traffic = traffic_of(compress("dcp", {frame, frame}, {}), {}, {7, 7, 2, 2});
  EXPECT_EQ(traffic.blocks, 4u);
  EXPECT_EQ(traffic.payload_bursts, 12u);
  EXPECT_EQ(traffic.raw_bursts, 64u);
}

// Lines of one burst: 128 / 16 = 8 blocks of DCP's CSB a line, one line per row of blocks.
TEST(ReadTraffic, TheCsbCacheForgetsTheLeastRecentlyUsedLine) {
  const auto frame = solid_frame(64, 32, 0xFF336699);
  const CompressedSurface surface = compress("dcp", {frame, frame}, {});
  SurfaceReader reader;
  Block block;
  ASSERT_TRUE(reader.open(surface, {.csb_lines = 2, .csb_line_bursts = 1}));
  const auto misses_after = [&](uint32_t bx, uint32_t by) {
    EXPECT_TRUE(reader.read_block(bx, by, block));
    return reader.traffic().csb_misses;
  };
  EXPECT_EQ(misses_after(0, 0), 1u);
  EXPECT_EQ(misses_after(0, 1), 2u);
  EXPECT_EQ(misses_after(1, 0), 2u) << "row 0 is held";
  EXPECT_EQ(misses_after(0, 2), 3u) << "row 1 goes";
  EXPECT_EQ(misses_after(2, 0), 3u);
  EXPECT_EQ(misses_after(1, 1), 4u);
  EXPECT_EQ(reader.traffic().csb_bursts, 4u);
}

TEST(ReadTraffic, WithoutACacheEveryBlockFetchesItsCsb) {
  const auto frame = solid_frame(64, 32, 0xFF336699);
  const CompressedSurface surface = compress("dcp", {frame, frame}, {});
  const auto traffic = traffic_of(surface, {.csb_lines = 0, .csb_line_bursts = 1}, {0, 0, 64, 32});
  EXPECT_EQ(traffic.csb_bursts, 32u);
}

// HDCP has 80 CSB bits a block: block 1 covers bits 80 … 159 and so two bursts of 128.
TEST(ReadTraffic, ACsbEntryAcrossTwoLinesFetchesBoth) {
  const auto frame = solid_frame(24, 8, 0xFF336699);
  const CompressedSurface surface = compress("hdcp", {frame, frame}, {});
  const auto traffic = traffic_of(surface, {.csb_lines = 4, .csb_line_bursts = 1}, {8, 0, 8, 8});
  EXPECT_EQ(traffic.csb_lookups, 2u);
  EXPECT_EQ(traffic.csb_bursts, 2u);
}

// 3 blocks × 80 bits = 240 bits = 2 bursts: a line of 4 bursts fetches no more than the plane has.
TEST(ReadTraffic, TheLastLineOfThePlaneIsAsShortAsThePlane) {
  const auto frame = solid_frame(24, 8, 0xFF336699);
  const auto traffic = traffic_of(compress("hdcp", {frame, frame}, {}), {}, {0, 0, 24, 8});
  EXPECT_EQ(traffic.csb_bursts, 2u);
}

TEST(ReadTraffic, TheBlockKeptIsNotFetchedAgain) {
  const auto frame = solid_frame(64, 32, 0xFF336699);
  const CompressedSurface surface = compress("dcp", {frame, frame}, {});
  SurfaceReader reader;
  uint32_t word = 0;
  ASSERT_TRUE(reader.open(surface, {}));
  for (uint32_t i = 0; i < 8; ++i) ASSERT_TRUE(reader.read_pixel(i, 7 - i, word));
  EXPECT_EQ(reader.traffic().blocks, 1u);
  ASSERT_TRUE(reader.read_pixel(8, 0, word));
  EXPECT_EQ(reader.traffic().blocks, 2u);
  reader.reset_traffic();
  EXPECT_EQ(reader.traffic().moved_bursts(), 0u);
}

// The first frame has no CCD: raw blocks, no table.
TEST(ReadTraffic, AFirstFrameIsReadRaw) {
  const auto frame = solid_frame(16, 16, 0xFF336699);
  const auto traffic = traffic_of(compress("dcp", {frame}, {}), {}, {0, 0, 16, 16});
  EXPECT_EQ(traffic.payload_bursts, 4u * 16);
  EXPECT_EQ(traffic.table_bursts, 0u);
}

// RGB565: a raw block is 1024 bits = 8 bursts; DCP's 384 bits stay 3 bursts; the rCCD is 64 × 17 = 1088 bits.
TEST(ReadTraffic, SixteenBitPixelsHaveSmallerRawBlocks) {
  SampleFrame frame{16, 8, PixelFormat::kRgb565, std::vector<uint32_t>(128, 0x1234), {}};
  frame.pack();
  const auto traffic = traffic_of(compress("dcp", {frame, frame}, {}), {}, {0, 0, 16, 8});
  EXPECT_EQ(traffic.payload_bursts, 6u);
  EXPECT_EQ(traffic.raw_bursts, 16u);
  EXPECT_EQ(traffic.table_bursts, 9u);
}

}  // namespace
}  // namespace tilepress
