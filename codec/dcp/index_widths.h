// Index widths: how many bits the CCD indices of a sub-block take.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "tilepress/block.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// Bits that the largest index of a sub-block takes; kRawWidth for kNotInCcd.
constexpr uint8_t width_of(uint16_t largest) {
  return largest == kNotInCcd ? kRawWidth : static_cast<uint8_t>(std::bit_width(largest));
}

/// The widths of the sub-blocks of a block.
inline void fill_widths(const uint16_t* indices, uint8_t* widths) {
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub, indices += kSubBlockPixels)
    widths[sub] = width_of(*std::max_element(indices, indices + kSubBlockPixels));
}

}  // namespace tilepress
