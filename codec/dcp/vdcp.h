// VDCP sub-blocks: the width of a sub-block's indices, shared by VDCP and the hybrid.
#pragma once

#include <bit>
#include <cstdint>

#include "dcp/dcp_family.h"

namespace tilepress {

/// Index width of a sub-block whose largest CCD index is `largest`: its bit width (index 0 → 0 bits, 1 → 1,
/// 2–3 → 2 …). The paper prints ceil(log2(max index)); its own example needs the bit width.
inline uint32_t vdcp_width(uint16_t largest) {
  return static_cast<uint32_t>(std::bit_width(largest));
}

/// Payload bits of a block; indices by raster position.
inline uint32_t vdcp_measure(const uint16_t* indices, uint32_t pixel_bits) {
  uint32_t bits = 0;
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    const uint16_t largest = largest_index(indices, sub);
    bits += kSubBlockPixels * (largest == kNotInCcd ? pixel_bits : vdcp_width(largest));
  }
  return bits;
}

/// Writes a block: per sub-block `csb_width` CSB bits holding the width, or `raw_mark` for a raw one.
/// indices == nullptr: all raw.
inline void vdcp_encode(const Block& block, const uint16_t* indices, uint32_t pixel_bits, uint32_t csb_width,
                        uint32_t raw_mark, BitWriter& payload, BitWriter& csb) {
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    const uint16_t largest = indices == nullptr ? kNotInCcd : largest_index(indices, sub);
    if (largest == kNotInCcd) {
      csb.put(raw_mark, csb_width);
      write_raw_sub_block(block, sub, pixel_bits, payload);
      continue;
    }
    const uint32_t width = vdcp_width(largest);
    csb.put(width, csb_width);
    for (uint32_t i = 0; i < kSubBlockPixels; ++i) payload.put(indices[sub_block_pixel(sub, i)], width);
  }
}

/// Reads one sub-block whose CSB holds `width` ≤ 10 (not the raw mark). False: an index beyond the rCCD.
inline bool vdcp_decode_sub_block(const Rccd& rccd, uint32_t width, uint32_t sub, BitReader& payload,
                                  Block& out) {
  for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
    const uint64_t index = payload.get(width);
    if (index >= rccd.colors.size()) return false;
    out.pixels[sub_block_pixel(sub, i)] = rccd.colors[index];
  }
  return true;
}

}  // namespace tilepress
