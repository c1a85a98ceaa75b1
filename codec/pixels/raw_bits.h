// Raw pixels in a bit stream, for blocks and sub-blocks that a scheme does not compress.
#pragma once

#include <cstdint>

#include "pixels/pixel_kernels.h"
#include "tilepress/bit_io.h"
#include "tilepress/block.h"

namespace tilepress {

/// Returns the raster position of pixel `i` (0..3) of sub-block `sub` (0..15).
constexpr uint32_t sub_block_pixel(uint32_t sub, uint32_t i) {
  return kTraversal[sub * kSubBlockPixels + i];
}

/// Appends `count` pixels, an even number.
inline void write_raw_pixels(const uint32_t* pixels, uint32_t count, uint32_t pixel_bits, BitWriter& out) {
  for (uint32_t i = 0; i < count; i += 2) {
    const uint64_t pair = uint64_t{pixels[i]} << pixel_bits | pixels[i + 1];
    if (pixel_bits == 32)
      out.put64(pair);
    else
      out.put(pair, 2 * pixel_bits);
  }
}

inline void read_raw_sub_block(BitReader& in, uint32_t sub, uint32_t pixel_bits, Block& block) {
  for (uint32_t i = 0; i < kSubBlockPixels; i += 2) {
    const uint64_t pair = pixel_bits == 32 ? in.get64() : in.get(2 * pixel_bits);
    block.pixels[sub_block_pixel(sub, i)] = static_cast<uint32_t>(pair >> pixel_bits);
    block.pixels[sub_block_pixel(sub, i + 1)] =
        static_cast<uint32_t>(pair & ((uint64_t{1} << pixel_bits) - 1));
  }
}

/// Appends a raw block: its pixels in traversal order.
inline void write_raw_block(const uint32_t* pixels, uint32_t pixel_bits, BitWriter& out) {
  write_raw_pixels(pixels, kBlockPixels, pixel_bits, out);
}

inline void read_raw_block(BitReader& in, uint32_t pixel_bits, Block& block) {
  const uint8_t* bytes = pixel_bits == 32 ? in.at_byte(kMaxRawBlockBits / 8) : nullptr;
  if (bytes != nullptr) {  // the common case
    pixel_kernels().read_raw(bytes, block.pixels.data());
    return in.skip(kMaxRawBlockBits);
  }
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) read_raw_sub_block(in, sub, pixel_bits, block);
}

}  // namespace tilepress
