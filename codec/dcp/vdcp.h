// VDCP sub-blocks: the width of a sub-block's indices, shared by VDCP and the hybrid; and how all that have
// indices of a width write them.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "raw_bits.h"
#include "simd/index_widths.h"
#include "simd/kernels.h"
#include "tilepress/scheme.h"

namespace tilepress {

// The index width of a sub-block is the bit width of its largest CCD index (0 → 0 bits, 1 → 1, 2–3 → 2 …).
// The paper prints ceil(log2(max index)); its own example needs the bit width.

/// Payload bits of a block.
inline uint32_t vdcp_measure(const BlockContext& block, uint32_t pixel_bits) {
  constexpr uint64_t kOnes = 0x0101010101010101;
  uint64_t sums = 0, raw = 0;  // byte by byte, of eight sub-blocks each
  for (uint32_t sub = 0; sub < kSubBlocks; sub += 8) {
    uint64_t widths;
    std::memcpy(&widths, block.ccd_widths + sub, 8);
    const uint64_t are_raw = widths >> 7 & kOnes;  // kRawWidth alone has the top bit
    raw += are_raw;
    sums += widths & ~(are_raw * 0xFF);
  }
  const auto bits = static_cast<uint32_t>((sums * kOnes >> 56) + (raw * kOnes >> 56) * pixel_bits);
  return kSubBlockPixels * bits;
}

/// Up to this width the indices of two sub-blocks fit into one put.
constexpr uint32_t kMaxPairedBits = kMaxBitsPerCall / (2 * kSubBlockPixels);

/// Widths of indices that Kernels::write_sub_blocks writes.
constexpr uint32_t kMaxWrittenBits = 7;

/// Widths of a block that is not looked up.
inline constexpr auto kAllRawWidths = [] {
  std::array<uint8_t, kSubBlocks> raw;
  raw.fill(kRawWidth);
  return raw;
}();

/// Of the sub-blocks; `look_up` = false: all raw.
inline const uint8_t* vdcp_widths(const BlockContext& block, bool look_up) {
  return look_up ? block.ccd_widths : kAllRawWidths.data();
}

/// Whether Kernels::write_sub_blocks may be used.
inline bool writes_at_once(uint32_t index_bits, uint32_t pixel_bits) {
  return pixel_bits == 32 && index_bits <= kMaxWrittenBits && kernels().byte_permutes;
}

/// Writes the payload of a block: of each sub-block its indices, as many bits each as `widths` says, at most
/// `index_bits`, or its pixels where that is kRawWidth.
inline void write_indices(const BlockContext& block, const uint8_t* widths, uint32_t index_bits,
                          uint32_t pixel_bits, BitWriter& payload) {
  if (writes_at_once(index_bits, pixel_bits))
    if (uint8_t* out = payload.at_byte(kMaxRawBlockBits / 8); out != nullptr)
      return payload.wrote(
          kernels().write_sub_blocks(block.pixels, block.ccd_indices, widths, kMaxWrittenBits, out).bits);
  if (block.uniform && widths[0] != kRawWidth) {  // sixteen equal sub-blocks
    const uint64_t index = block.ccd_indices[0];
    const uint32_t width = widths[0];
    uint64_t indices = 0;
    for (uint32_t i = 0; i < kSubBlockPixels; ++i) indices = indices << width | index;
    BitWriter out = payload;  // a copy stays in registers
    for (uint32_t sub = 0; sub < kSubBlocks && width != 0; ++sub) out.put(indices, kSubBlockPixels * width);
    payload = out;
    return;
  }
  uint32_t packed[kSubBlocks];
  const bool pairs = block.ccd_indices != nullptr && index_bits <= kMaxPairedBits;
  if (pairs) kernels().pack(block.ccd_indices, widths, packed);
  BitWriter out = payload;
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    const uint32_t at = sub * kSubBlockPixels, width = widths[sub];
    if (width == kRawWidth) {
      write_raw_pixels(block.pixels + at, kSubBlockPixels, pixel_bits, out);
    } else if (pairs) {
      const uint32_t next = sub + 1 < kSubBlocks ? widths[sub + 1] : kRawWidth;
      if (next == kRawWidth) {
        out.put(packed[sub], kSubBlockPixels * width);
      } else {  // two at once
        out.put(uint64_t{packed[sub]} << kSubBlockPixels * next | packed[sub + 1],
                kSubBlockPixels * (width + next));
        ++sub;
      }
    } else {
      uint64_t indices = 0;  // four of at most 10 bits
      for (uint32_t i = 0; i < kSubBlockPixels; ++i) indices = indices << width | block.ccd_indices[at + i];
      out.put(indices, kSubBlockPixels * width);
    }
  }
  payload = out;
}

/// Writes a block as VDCP does: per sub-block `csb_width` ≤ 5 CSB bits holding the width, or all ones for a
/// raw one. `look_up` = false: all raw.
inline void vdcp_encode(const BlockContext& block, bool look_up, uint32_t index_bits, uint32_t pixel_bits,
                        uint32_t csb_width, BitWriter& payload, BitWriter& csb) {
  const uint8_t* widths = vdcp_widths(block, look_up);
  for (uint32_t half = 0; half < kSubBlocks; half += kSubBlocks / 2) {
    uint64_t marks = 0;
    for (uint32_t sub = half; sub < half + kSubBlocks / 2; ++sub)
      marks = marks << csb_width | (widths[sub] & ((1u << csb_width) - 1));  // all ones of kRawWidth
    csb.put(marks, kSubBlocks / 2 * csb_width);
  }
  write_indices(block, widths, index_bits, pixel_bits, payload);
}

}  // namespace tilepress
