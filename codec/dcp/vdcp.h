// VDCP sub-blocks: the width of a sub-block's indices, shared by VDCP and the hybrid.
#pragma once

#include <bit>
#include <cstdint>

#include "dcp/dcp_family.h"
#include "simd/kernels.h"

namespace tilepress {

/// Index width of a sub-block whose largest CCD index is `largest`: its bit width (index 0 → 0 bits, 1 → 1,
/// 2–3 → 2 …). The paper prints ceil(log2(max index)); its own example needs the bit width.
inline uint32_t vdcp_width(uint32_t largest) {
  return static_cast<uint32_t>(std::bit_width(largest));
}

/// Payload bits of a block: four times the widths of its sub-blocks, the sum over all pixels.
inline uint32_t vdcp_measure(const BlockContext& block, uint32_t pixel_bits) {
  if (block.uniform) {
    const uint32_t index = block.ccd_indices[0];
    return kBlockPixels * (index == kNotInCcd ? pixel_bits : vdcp_width(index));
  }
  return kernels().width_sum(block.ccd_largest, kNotInCcd, pixel_bits);
}

/// Writes a block: per sub-block `csb_width` ≤ 5 CSB bits holding the width, or `raw_mark` for a raw one.
/// `look_up` = false: all raw.
inline void vdcp_encode(const BlockContext& block, bool look_up, uint32_t pixel_bits, uint32_t csb_width,
                        uint32_t raw_mark, BitWriter& payload, BitWriter& csb) {
  if (block.uniform && look_up && block.ccd_largest[0] != kNotInCcd) {  // sixteen equal sub-blocks
    const uint64_t index = block.ccd_indices[0];
    const uint32_t width = vdcp_width(block.ccd_largest[0]);
    uint64_t marks = 0, indices = 0;
    for (uint32_t sub = 0; sub < 8; ++sub) marks = marks << csb_width | width;
    for (uint32_t i = 0; i < kSubBlockPixels; ++i) indices = indices << width | index;
    csb.put(marks, 8 * csb_width);
    csb.put(marks, 8 * csb_width);
    BitWriter out = payload;  // a copy stays in registers
    for (uint32_t sub = 0; sub < kSubBlocks && width != 0; ++sub) out.put(indices, kSubBlockPixels * width);
    payload = out;
    return;
  }
  BitWriter out = payload;
  uint64_t marks = 0;  // of eight sub-blocks
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    const uint32_t at = sub * kSubBlockPixels;
    const uint32_t largest = look_up ? block.ccd_largest[at] : kNotInCcd;
    const uint32_t width = vdcp_width(largest);
    marks = marks << csb_width | (largest == kNotInCcd ? raw_mark : width);
    if (sub % 8 == 7) {
      csb.put(marks, 8 * csb_width);
      marks = 0;
    }
    if (largest == kNotInCcd) {
      write_raw_pixels(block.pixels + at, kSubBlockPixels, pixel_bits, out);
    } else {
      uint64_t indices = 0;  // four of at most 10 bits
      for (uint32_t i = 0; i < kSubBlockPixels; ++i) indices = indices << width | block.ccd_indices[at + i];
      out.put(indices, kSubBlockPixels * width);
    }
  }
  payload = out;
}

/// Reads one sub-block whose CSB holds `width` ≤ 10 (not the raw mark). False: an index beyond the rCCD.
inline bool vdcp_decode_sub_block(const Rccd& rccd, uint32_t width, uint32_t sub, BitReader& payload,
                                  Block& out) {
  const uint64_t indices = payload.get(kSubBlockPixels * width);
  const uint64_t mask = (uint64_t{1} << width) - 1;
  for (uint32_t i = 0; i < kSubBlockPixels; ++i) {
    const uint64_t index = indices >> (3 - i) * width & mask;
    if (index >= rccd.colors.size()) return false;
    out.pixels[sub_block_pixel(sub, i)] = rccd.colors[index];
  }
  return true;
}

}  // namespace tilepress
