// BPC line: bit-plane compression of 32 words (Kim et al. 2016).
//
//   base      000 = 0 | 001 + 4 bits | 010 + 8 bits | 011 + 16 bits, each sign-extended | 1 + 32 bits
//   planes    from 32 down to 0:
//               01 + 5 bits      2 … 33 planes of zero DBX (the count less 2)
//               001              one plane of zero DBX
//               00000            DBX all ones
//               00001            DBX not zero, but DBP is
//               00010 + 5 bits   DBX has two ones side by side, the lower at this position
//               00011 + 5 bits   DBX has a single one, at this position
//               1 + 31 bits      DBX
//             delta i = word i+1 − word i in 33 bits, i = 0 … 30. Plane b (DBP b) holds bit b of all deltas;
//             DBX 32 = DBP 32, DBX b = DBP b xor DBP b+1.
#pragma once

#include <array>
#include <cstdint>

#include "tilepress/bit_io.h"

namespace tilepress {

constexpr uint32_t kBpcWords = 32;

/// Returns the bits of the stream.
uint32_t bpc_line_bits(const uint32_t* words);
void bpc_line_write(const uint32_t* words, BitWriter& out);
/// Returns false if no encoder writes these bits.
bool bpc_line_read(BitReader& in, uint32_t* words);

}  // namespace tilepress
