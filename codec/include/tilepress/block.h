// Block: the 8×8 pixels that go to memory as one unit, and the order of its pixels.
#pragma once

#include <array>
#include <cstdint>

namespace tilepress {

constexpr uint32_t kBlockSide = 8;
constexpr uint32_t kBlockPixels = 64;
constexpr uint32_t kSubBlockSide = 2;
constexpr uint32_t kSubBlocks = 16;  ///< sub-blocks of a block
constexpr uint32_t kSubBlockPixels = 4;
constexpr uint32_t kMaxRawBlockBits = 2048;  ///< 64 pixels of 32 bits

/// Pixel words in raster order: pixel (x, y) is pixels[8 * y + x].
struct Block {
  std::array<uint32_t, kBlockPixels> pixels;
  bool operator==(const Block&) const = default;
};

/// Returns the raster position of each pixel in traversal order: 2×2 sub-blocks in raster order,
/// and the pixels of a sub-block in raster order. Sub-block s has traversal positions 4s … 4s+3.
constexpr std::array<uint8_t, kBlockPixels> make_traversal() {
  std::array<uint8_t, kBlockPixels> order{};
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    const uint32_t sub = i / 4, in_sub = i % 4;
    const uint32_t x = (sub % 4) * 2 + in_sub % 2;
    const uint32_t y = (sub / 4) * 2 + in_sub / 2;
    order[i] = static_cast<uint8_t>(8 * y + x);
  }
  return order;
}
constexpr std::array<uint8_t, kBlockPixels> kTraversal = make_traversal();

}  // namespace tilepress
