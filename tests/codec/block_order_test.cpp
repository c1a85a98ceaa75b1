// Order of blocks and pixels, and the plane a surface is copied to.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "surface_patterns.h"
#include "tilepress/block.h"
#include "tilepress/plane.h"
#include "tilepress/tiler.h"

using namespace tilepress;

namespace {

std::vector<std::pair<uint32_t, uint32_t>> visited(uint32_t blocks_x, uint32_t blocks_y, uint32_t tile_side) {
  std::vector<std::pair<uint32_t, uint32_t>> order;
  for_each_block_in_tiles(blocks_x, blocks_y, tile_side,
                          [&](uint32_t bx, uint32_t by) { order.emplace_back(bx, by); });
  return order;
}

PixelPlane plane_of(const reference::Picture& picture, PixelFormat format, ByteOrder order, bool bottom_up,
                    uint32_t padding) {
  PixelPlane plane;
  plane.assign(patterns::MemorySurface(picture, format, order, bottom_up, padding).view());
  return plane;
}

}  // namespace

TEST(BlockOrder, PixelsGoBySubBlocksInRasterOrder) {
  // Sub-block 0 is (0,0) (1,0) (0,1) (1,1); sub-block 1 begins at (2,0); sub-block 4 at (0,2).
  const std::array<uint8_t, 8> first = {0, 1, 8, 9, 2, 3, 10, 11};
  for (size_t i = 0; i < first.size(); ++i) EXPECT_EQ(kTraversal[i], first[i]);
  EXPECT_EQ(kTraversal[16], 16);  // sub-block 4: raster position 8·2 + 0
  EXPECT_EQ(kTraversal[63], 63);
}

TEST(BlockOrder, TilesOf32PixelsHoldFourByFourBlocks) {
  const auto order = visited(8, 8, 32);
  ASSERT_EQ(order.size(), 64u);
  EXPECT_EQ(order[3], std::make_pair(3u, 0u));
  EXPECT_EQ(order[4], std::make_pair(0u, 1u));   // next row of the first tile
  EXPECT_EQ(order[16], std::make_pair(4u, 0u));  // second tile
  EXPECT_EQ(order[32], std::make_pair(0u, 4u));  // second row of tiles
}

TEST(BlockOrder, TilesOf64PixelsHoldEightByEightBlocks) {
  const auto order = visited(9, 9, 64);
  ASSERT_EQ(order.size(), 81u);
  EXPECT_EQ(order[7], std::make_pair(7u, 0u));
  EXPECT_EQ(order[8], std::make_pair(0u, 1u));
  EXPECT_EQ(order[64], std::make_pair(8u, 0u));  // a tile of one column
  EXPECT_EQ(order[72], std::make_pair(0u, 8u));  // a tile of one row
  EXPECT_EQ(order[80], std::make_pair(8u, 8u));
}

TEST(BlockOrder, ATileAsSmallAsABlockGivesRasterOrder) {
  const std::vector<std::pair<uint32_t, uint32_t>> raster = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  EXPECT_EQ(visited(3, 2, 8), raster);
}

TEST(PixelPlane, PadsByRepeatingTheNearestPixelInside) {
  const reference::Picture picture{3, 2, {1, 2, 3, 4, 5, 6}};
  const PixelPlane plane = plane_of(picture, PixelFormat::kRgba8, ByteOrder::kRgba, false, 0);
  EXPECT_EQ(plane.blocks(), 1u);
  Block block;
  plane.load_block(0, 0, block);
  for (uint32_t y = 0; y < 8; ++y)
    for (uint32_t x = 0; x < 8; ++x)
      EXPECT_EQ(block.pixels[8 * y + x], picture.padded(x, y)) << x << "," << y;
  EXPECT_EQ(block.pixels[63], 6u);
}

TEST(PixelPlane, ReadsBottomUpBgraRowsWithAPitchAsTheSamePicture) {
  const reference::Picture picture = patterns::draw(patterns::kNoise, 13, 9, PixelFormat::kRgba8, 7);
  const PixelPlane plain = plane_of(picture, PixelFormat::kRgba8, ByteOrder::kRgba, false, 0);
  const PixelPlane other = plane_of(picture, PixelFormat::kRgba8, ByteOrder::kBgra, true, 64);
  for (uint32_t y = 0; y < 16; ++y)
    for (uint32_t x = 0; x < 16; ++x) {
      EXPECT_EQ(plain.row(y)[x], picture.padded(x, y));
      EXPECT_EQ(other.row(y)[x], picture.padded(x, y));
    }
}

TEST(PixelPlane, ForcesAlphaWhereThereIsNone) {
  const reference::Picture picture{1, 1, {0x00332211}};
  EXPECT_EQ(plane_of(picture, PixelFormat::kRgbx8, ByteOrder::kRgba, false, 0).row(0)[0], 0xFF332211u);
}

TEST(PixelPlane, HoldsA16BitPixelPerWord) {
  const reference::Picture picture{2, 1, {0xF81F, 0x07E0}};
  const PixelPlane plane = plane_of(picture, PixelFormat::kRgb565, ByteOrder::kRgba, false, 4);
  EXPECT_EQ(plane.row(0)[0], 0xF81Fu);
  EXPECT_EQ(plane.row(0)[1], 0x07E0u);
  const FormatTraits& format = traits(PixelFormat::kRgb565);
  EXPECT_EQ(channel(format, 0xF81F, 0), 31u);
  EXPECT_EQ(channel(format, 0xF81F, 1), 0u);
  EXPECT_EQ(channel(format, 0xF81F, 2), 31u);
  EXPECT_EQ(channel(format, 0xF81F, 3), 0u);
}
