// Index widths: the bits of a sub-block's CCD indices.
//
// The width is the bit width of the largest index: 0 → 0 bits, 1 → 1, 2 and 3 → 2 … The paper prints
// ceil(log2(max index)), but its own example needs the bit width.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "tilepress/block.h"

namespace tilepress {

constexpr uint16_t kNotInCcd = 0xFFFF;
/// Stands for the width of a sub-block with a pixel that the CCD lacks.
constexpr uint8_t kRawWidth = 0xFF;

/// Returns the width for the largest index of a sub-block; kRawWidth for kNotInCcd.
constexpr uint8_t width_of(uint16_t largest) {
  return largest == kNotInCcd ? kRawWidth : static_cast<uint8_t>(std::bit_width(largest));
}

/// Fills the widths of the 16 sub-blocks of a block.
inline void fill_widths(const uint16_t* indices, uint8_t* widths) {
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub, indices += kSubBlockPixels)
    widths[sub] = width_of(*std::max_element(indices, indices + kSubBlockPixels));
}

}  // namespace tilepress
