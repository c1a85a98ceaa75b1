// DCC line: 8×2 pixels as AMD's delta colour compression codes them, and groups of lines that share 64 bytes.
//
//   group     |flags of each line|bases of each line|differences of each line|0 …|       512 bits
//
//   channels  G, Cr = R − G, Cb = B − G, A, mod 256, in this order
//   halves    a line has a left and a right half of 4×2 pixels; u0 … u3 are the upper pixels of a half, l0 …
//   l3
//             the lower ones. Pixel order: u0 u1 l0 l1 u2 u3 l2 l3, which is the block's traversal order
//   flags     per channel |left has a byte|right has a byte|, then per channel |left constant|right constant|
//   bases     per channel and half that has a byte. Constant: its value. Else the lowest set bit, at n, says
//   n
//             planes (0 … 7), and the bits above it are the bits of u0 above bit n
//   differences   per channel and half that is not constant: |signs 8|plane 8 × n|, pixel i at bit i, the
//             plane of lowest bits first. Magnitude m and sign s: difference m, or 255 − m with s = 1 (mod
//             256)
//               u1 − u0, l0 − u0, l1 − l0, u2 − u1, u3 − u2, l2 − u2, l3 − l2
//             u0 of a half with a byte: 2m + s is its low n + 1 bits
//             u0 of a left half without a byte: its difference from 0, and n = 7
//             u0 of a right half without a byte: its difference from u3 of the left half, and n of the left
//             half
//   constant without a byte   the left half is 0, the right half repeats u3 of the left half
//
// Bits count from the low end of each byte.
#pragma once

#include <array>
#include <cstdint>

#include "pixels/low_first_bits.h"

namespace tilepress {

constexpr uint32_t kDccLines = 4;  ///< of a block
constexpr uint32_t kDccLinePixels = 16;
constexpr uint32_t kDccGroupBytes = 64;  ///< memory of a group, as of one raw line

/// How one channel of a line is coded.
struct DccForm {
  uint8_t left_byte = 0, right_byte = 0, left_constant = 0, right_constant = 0;  ///< 0 or 1
  uint8_t left_planes = 0, right_planes = 0;  ///< n of a half that is not constant
  /// Returns the bytes of bases and differences.
  uint32_t bytes() const {
    return left_byte + right_byte + (left_constant ? 0u : 1u + left_planes) +
           (right_constant ? 0u : 1u + right_planes);
  }
};

/// The lines of a block, their channels, and how each channel is coded.
struct DccBlock {
  /// Channel c of pixel i of half h of line l is values[i][h][4l + c].
  alignas(64) uint8_t values[8][2][4 * kDccLines];
  std::array<DccForm, 4 * kDccLines> forms;    ///< [4l + c]
  std::array<uint32_t, kDccLines> line_bytes;  ///< with flags: what the line takes of its group
};

/// Finds the smallest form of every channel. `pixels`: 64 in traversal order.
DccBlock dcc_analyse(const uint32_t* pixels);
/// Appends lines first … first + count − 1. Precondition: their line_bytes sum to at most kDccGroupBytes.
void dcc_write_group(const DccBlock& block, uint32_t first, uint32_t count, BitWriter& out);
/// Restores `count` lines of 16 pixels in traversal order. Returns false if no encoder writes these bits.
bool dcc_read_group(BitReader& in, uint32_t count, uint32_t* pixels);

}  // namespace tilepress
