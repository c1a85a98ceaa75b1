// Intel11 unit: one memory line or a pair of lines, coded as differences from bases; the choice of bases.
//
//   |inter 1|extension 8|width 4 ×3|base 8 ×3|base A 8|slots …|0 …|
//
//   order     widths, bases and differences stand in the order R, G, B; with inter = 1: B, R, G. A is last.
//   widths    bits of a difference, 0 … 8. The width of A is not stored: it is what the other three leave of
//             the slot, at most 8.
//   slot      one pixel: its four differences, then zeros; 14 bits in a pair of 64 bytes, 6 bits in a pair of
//             32 bytes, 12 bits in a line of 32 bytes. Pixels stand by 2×2 blocks, left line first.
//   value     base + d. With inter = 1, mod 256: b = base + d, r = base + b + d, g = base + (b + r) / 2 + d.
//   extension bit i: 2×2 block i of the pair has one colour. Exactly four bits or none are set, four only in
//             a pair of 64 bytes. Then there are 20 slots of 22 bits (a slot for such a block, four for the
//             others): first the low 14 bits of each slot, then the high 8 bits of each.
#pragma once

#include <array>
#include <cstdint>

#include "intel/byte_ranges.h"
#include "tilepress/bit_io.h"

namespace tilepress {

/// Bases and widths in the order in which the header has them, A last.
struct Intel11Bases {
  bool inter = false;
  std::array<uint8_t, 4> base{}, width{};
  uint32_t color_bits() const { return uint32_t{width[0]} + width[1] + width[2]; }
  uint32_t bits() const { return color_bits() + width[3]; }
};

/// What a line or a pair needs to know of its pixels to choose bases.
struct Intel11Ranges {
  ByteRanges plain;      ///< R, G, B, A
  ByteRanges predicted;  ///< r − b and g − (b + r) / 2 mod 256, then both plus 128
};
Intel11Ranges united(const Intel11Ranges& a, const Intel11Ranges& b);

/// Returns the ranges of line `line` of a pair of 32 pixels.
Intel11Ranges intel11_ranges(const uint32_t* pair, uint32_t line);
/// Each base is the smallest value.
Intel11Bases plain_bases(const Intel11Ranges& ranges);
/// The bases of B and A are the smallest values. The bases of R and G begin the narrower of two windows: all
/// values as they are, and all values plus 128 (mod 256). One of the two is the smallest window wherever
/// fewer than 8 bits suffice.
Intel11Bases inter_bases(const Intel11Ranges& ranges);

/// How a unit lies in its memory.
struct Intel11Layout {
  uint32_t bytes;      ///< 32 or 64
  uint32_t slot_bits;  ///< of a pixel
  uint32_t first_line, lines;
};
constexpr Intel11Layout kIntel11Pair64 = {64, 14, 0, 2};
constexpr Intel11Layout kIntel11Pair32 = {32, 6, 0, 2};
constexpr Intel11Layout intel11_line(uint32_t line) {
  return {32, 12, line, 1};
}
constexpr uint32_t kExtendedSlotBits = 22;
constexpr uint32_t kUniformBlocks = 4;  ///< of an extended pair

/// Returns the flags of the first four 2×2 blocks of one colour, 0 if there are fewer. Blocks count by lines:
/// the left line has blocks 0 … 3.
uint32_t intel11_extension(const uint32_t* pair);

/// Appends the unit. Precondition: bases.bits() is at most the layout's slot (22 bits with an extension).
void intel11_write(const uint32_t* pair, const Intel11Layout& layout, const Intel11Bases& bases,
                   uint32_t extension, BitWriter& out);
/// Returns false if no encoder writes these bits.
bool intel11_read(BitReader& in, const Intel11Layout& layout, uint32_t* pair);

}  // namespace tilepress
