// Pixel pair: the 8×4 pixels that Intel GPUs compress as one, two memory lines of 4×4 pixels side by side.
#pragma once

#include <cstdint>

#include "pixels/low_first_bits.h"
#include "tilepress/bit_io.h"
#include "tilepress/block.h"

namespace tilepress {

/// A block has two pairs, rows 0–3 and rows 4–7. The pixels of a pair are half of the block's pixels in
/// traversal order: 2×2 sub-blocks 0, 1, 4, 5 are the first (left) line, 2, 3, 6, 7 the second line.
constexpr uint32_t kPairs = 2;
constexpr uint32_t kPairPixels = 32;
constexpr uint32_t kPairLines = 2;
constexpr uint32_t kPairLinePixels = 16;
constexpr uint32_t kRawLineBytes = 64;
constexpr uint32_t kRawLineBits = kRawLineBytes * 8;

/// Returns the position in the pair of pixel `i` of a line, counting by 2×2 sub-blocks.
constexpr uint32_t quad_position(uint32_t line, uint32_t i) {
  return i / 8 * 16 + line * 8 + i % 8;
}
/// Returns the position in the pair of pixel `i` of a line, counting row by row.
constexpr uint32_t row_position(uint32_t line, uint32_t i) {
  const uint32_t x = i % 4, y = i / 4;
  return quad_position(line, y / 2 * 8 + x / 2 * 4 + y % 2 * 2 + x % 2);
}

/// Appends a line that is not compressed: its pixels row by row, bytes R, G, B, A.
inline void write_raw_pair_line(const uint32_t* pair, uint32_t line, BitWriter& out) {
  LowFirstBits bits;
  for (uint32_t i = 0; i < kPairLinePixels; ++i) bits.put(pair[row_position(line, i)], 32);
  bits.write(out, kRawLineBytes);
}
inline void read_raw_pair_line(BitReader& in, uint32_t line, uint32_t* pair) {
  LowFirstBits bits = LowFirstBits::read(in, kRawLineBytes);
  for (uint32_t i = 0; i < kPairLinePixels; ++i) pair[row_position(line, i)] = bits.get(32);
}

/// Puts the pixels of pair `index` into the block.
inline void place_pair(const uint32_t* pair, uint32_t index, Block& out) {
  for (uint32_t i = 0; i < kPairPixels; ++i) out.pixels[kTraversal[index * kPairPixels + i]] = pair[i];
}

}  // namespace tilepress
