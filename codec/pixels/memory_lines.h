// Memory lines: a block's pixels as 32-bit words for cache-line codecs.
#pragma once

#include <array>
#include <cstdint>

#include "tilepress/scheme.h"

namespace tilepress {

/// Order in which a block's pixels fill memory lines, as the choices of the key.
enum class LineOrder : uint8_t { kRaster, kQuad };

/// The key of cache-line codecs.
inline constexpr SchemeKey kOrderKey[] = {{.name = "order",
                                           .kind = KeyKind::kChoice,
                                           .summary = "order of a block's pixels in memory lines",
                                           .choices = "raster, quad"}};
inline LineOrder line_order(const SchemeSpec& spec) {
  return static_cast<LineOrder>(spec.number("order"));
}

/// The block's bytes as little-endian words: 64 words of 32-bit pixels, or 32 words of two 16-bit pixels, the
/// first in the low half.
struct LineWords {
  uint32_t count = 0;
  std::array<uint32_t, kBlockPixels> words;
};

/// Returns the raster position of the i-th pixel in memory.
inline uint32_t line_pixel(LineOrder order, uint32_t i) {
  return order == LineOrder::kQuad ? kTraversal[i] : i;
}

inline LineWords to_line_words(const Block& block, LineOrder order, uint32_t pixel_bits) {
  LineWords lines;
  if (pixel_bits == 32) {
    lines.count = kBlockPixels;
    if (order == LineOrder::kRaster) {
      lines.words = block.pixels;
      return lines;
    }
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
