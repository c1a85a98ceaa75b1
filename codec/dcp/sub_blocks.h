// Sub-blocks: the payload that DCP, ADCP, VDCP and HDCP share.
//
//   per sub-block, in order     its four CCD indices, `width` bits each; or its four pixels if it is raw
//
// The schemes differ in the widths they choose and in how the CSB names the widths.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "dcp/index_widths.h"
#include "dcp/sub_block_kernels.h"
#include "tilepress/bit_io.h"
#include "tilepress/block.h"

namespace tilepress {

/// One block, in traversal order.
struct SubBlocks {
  const uint32_t* pixels;   ///< 64
  const uint16_t* indices;  ///< 64; null if every sub-block is raw
  const uint8_t* widths;    ///< 16: bits of an index, or kRawWidth
};

/// The widths of a block whose sub-blocks are all raw.
inline constexpr auto kAllRawWidths = [] {
  std::array<uint8_t, kSubBlocks> raw;
  raw.fill(kRawWidth);
  return raw;
}();

/// Returns the payload bits of a block.
inline uint32_t payload_bits(const uint8_t* widths, uint32_t pixel_bits) {
  constexpr uint64_t kOnes = 0x0101010101010101;
  uint64_t sums = 0, raw = 0;  // byte by byte, for eight sub-blocks each
  for (uint32_t sub = 0; sub < kSubBlocks; sub += 8) {
    uint64_t eight;
    std::memcpy(&eight, widths + sub, 8);
    const uint64_t are_raw = eight >> 7 & kOnes;  // only kRawWidth has the top bit
    raw += are_raw;
    sums += eight & ~(are_raw * 0xFF);
  }
  const auto bits = static_cast<uint32_t>((sums * kOnes >> 56) + (raw * kOnes >> 56) * pixel_bits);
  return kSubBlockPixels * bits;
}

/// Returns the number of sub-blocks of a width up to `limit`. Raw sub-blocks do not count.
inline uint32_t count_up_to(const uint8_t* widths, uint32_t limit) {
  constexpr uint64_t kOnes = 0x0101010101010101;
  uint64_t beyond = 0;  // byte by byte
  for (uint32_t sub = 0; sub < kSubBlocks; sub += 8) {
    uint64_t eight;
    std::memcpy(&eight, widths + sub, 8);
    beyond += ((eight & 0x7F * kOnes) + (0x7F - limit) * kOnes) >> 7 & kOnes;
  }
  return kSubBlocks - static_cast<uint32_t>(beyond * kOnes >> 56);
}

/// Largest index width that the sub-block kernels take.
constexpr uint32_t kMaxKernelWidth = 7;
/// True if SubBlockKernels::write serves blocks of these widths and pixels.
inline bool has_write_kernel(uint32_t largest_width, uint32_t pixel_bits) {
  return pixel_bits == 32 && largest_width <= kMaxKernelWidth && sub_block_kernels().write != nullptr;
}

/// Appends the payload: the definition.
void write_payload_plainly(const SubBlocks& block, uint32_t pixel_bits, BitWriter& payload);
/// The same in the fastest way. No index is wider than `largest_width`.
void write_payload(const SubBlocks& block, uint32_t largest_width, uint32_t pixel_bits, BitWriter& payload);

/// Appends the CSB of VDCP and HDCP: the widths, `mark_bits` ≤ 5 each, all ones for a raw sub-block.
void write_widths(const uint8_t* widths, uint32_t mark_bits, BitWriter& csb);

}  // namespace tilepress
