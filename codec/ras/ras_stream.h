// RAS stream: median-edge prediction and Golomb-Rice codes per colour plane.
//
//   per plane                    first pixel, raw (plane bits wide)
//   per plane, per 2×2 group     3 bits k; k = 7: all residuals zero, nothing follows; else per residual
//                                (u >> k) one-bits, a zero-bit, the low k bits of u
// Planes in the order R,G,B,A or Y,Co,Cg,A; absent channels have no plane. Groups in raster order; the group
// of the first pixel has three residuals.
#pragma once

#include <cstdint>

#include "tilepress/bit_io.h"
#include "tilepress/block.h"
#include "tilepress/pixel_format.h"

namespace tilepress {

/// Bits of the groups of a plane whose residuals are all zero.
constexpr uint32_t kRasZeroPlaneBits = kSubBlocks * 3;
/// Returns the bits of the groups of four planes of the 8×8 block at `top_left`. An absent plane counts as
/// one of zeros. A row of the plane of pixels has `stride` words.
uint32_t ras_group_bits(const uint32_t* top_left, uint32_t stride, const FormatTraits& format, bool ycocg);
/// Returns the bits of a stream beside ras_group_bits: its first pixels, less the groups of absent planes.
/// May be negative.
int32_t ras_bits_beside_groups(const FormatTraits& format, bool ycocg);
void ras_stream_write(const Block& block, const FormatTraits& format, bool ycocg, BitWriter& out);
/// Returns false if no encoder writes these bits.
bool ras_stream_read(BitReader& in, const FormatTraits& format, bool ycocg, Block& out);

}  // namespace tilepress
