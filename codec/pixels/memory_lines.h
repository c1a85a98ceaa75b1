// Memory lines: a block's pixels as the 32-bit words that cache-line codecs see.
#pragma once

#include <array>
#include <cstdint>

#include "tilepress/scheme.h"

namespace tilepress {

/// The block's bytes as little-endian words, pixels row by row, or in traversal order (2×2 quads). 64 words
/// of 32-bit pixels, or 32 words of two 16-bit pixels each, the first one in the low half.
struct LineWords {
  uint32_t count = 0;
  std::array<uint32_t, kBlockPixels> words;
};

/// Raster position of the i-th pixel in memory.
inline uint32_t line_pixel(LineOrder order, uint32_t i) {
  return order == LineOrder::kQuad ? kTraversal[i] : i;
}

inline LineWords to_line_words(const Block& block, LineOrder order, uint32_t pixel_bits) {
  LineWords lines;
  if (pixel_bits == 32) {
    lines.count = kBlockPixels;
    for (uint32_t i = 0; i < kBlockPixels; ++i) lines.words[i] = block.pixels[line_pixel(order, i)];
    return lines;
  }
  lines.count = kBlockPixels / 2;
  for (uint32_t i = 0; i < lines.count; ++i)
    lines.words[i] = block.pixels[line_pixel(order, 2 * i)] | block.pixels[line_pixel(order, 2 * i + 1)]
                                                                  << 16;
  return lines;
}

inline void from_line_words(const LineWords& lines, LineOrder order, uint32_t pixel_bits, Block& block) {
  for (uint32_t i = 0; i < kBlockPixels; ++i)
    block.pixels[line_pixel(order, i)] =
        pixel_bits == 32 ? lines.words[i] : lines.words[i / 2] >> 16 * (i % 2) & 0xFFFFu;
}

}  // namespace tilepress
