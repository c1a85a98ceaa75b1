// Huffman blocks: sub-blocks of canonical codes over a dictionary, which HuffDCP and FBC share.
//
//   CSB       16 × 1 bit, in sub-block order: 1 = compressed, 0 = raw
//   payload   per sub-block: compressed  4 canonical codes, fewer than 4 × pixel bits together
//                            raw         4 × pixel bits
//   tables    per slot of the dictionary a valid bit and a colour; then per slot a code length of 6 bits, 0
//   in invalid
//             slots
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dictionary/color_table.h"
#include "dictionary/huffman.h"
#include "tilepress/block.h"

namespace tilepress {

/// Returns the bits of a block in codes of `lengths`, up to 127 each, by index. A sub-block takes at most
/// `raw_bits`, and exactly `raw_bits` if one of its indices is kNoColor. raw_bits is 64 or 128; indices are
/// below 64. Null where no version is faster than the plain loop.
using CodeSum = uint32_t (*)(const uint16_t* indices, const uint8_t* lengths, uint32_t raw_bits);
CodeSum code_sum_kernel();

/// Bits of the tables.
constexpr uint64_t huffman_table_bits(uint32_t slots, uint32_t pixel_bits) {
  constexpr uint32_t kLengthBits = 6;
  return uint64_t{slots} * (pixel_bits + 1 + kLengthBits);
}

class HuffmanBlockWriter {
 public:
  explicit HuffmanBlockWriter(uint32_t pixel_bits) : pixel_bits_(pixel_bits) {}
  /// Builds the codes of a dictionary from the counts of its colours.
  void build(std::span<const uint32_t> counts);
  /// Appends the tables. `colors` are as many as the counts.
  void write_tables(std::span<const uint32_t> colors, uint32_t slots, BitWriter& out) const;

  // `indices` has the index of each pixel in traversal order, kNoColor where the dictionary lacks the colour.
  /// Returns the payload bits of a block.
  uint32_t measure(const uint16_t* indices, bool uniform) const;
  /// Appends the payload of a block and returns its CSB bits.
  uint32_t encode(const uint32_t* pixels, const uint16_t* indices, BitWriter& payload) const;

 private:
  uint32_t raw_bits() const { return kSubBlockPixels * pixel_bits_; }
  uint32_t sub_block_bits(const uint16_t* indices) const;
  void write_codes(const uint16_t* indices, BitWriter& out) const;
  const uint32_t pixel_bits_;
  std::vector<uint8_t> lengths_;
  std::array<uint8_t, 64> first_lengths_{};  ///< the same for the kernel, if they are no more
  CanonicalCode code_;
};

class HuffmanBlockReader {
 public:
  explicit HuffmanBlockReader(uint32_t pixel_bits) : pixel_bits_(pixel_bits) {}
  /// Reads the tables; 0 bits are no dictionary. Returns false if no writer makes them.
  bool read_tables(BitReader& tables, uint64_t table_bits);
  const ColorTable& table() const { return table_; }
  /// Restores a block from its CSB bits and its payload.
  bool decode(uint64_t marks, BitReader& payload, Block& out) const;

 private:
  struct SubBlock {
    uint32_t color[kSubBlockPixels];
    uint64_t codes;
    uint32_t length;  ///< of the codes together; 0: too many to compare
  };
  bool read_sub_block(BitReader& in, SubBlock& out) const;
  static uint32_t skip_alike(uint64_t marks, const SubBlock& sub_block, BitReader& stream);
  const uint32_t pixel_bits_;
  ColorTable table_;
  CanonicalCode code_;
};

}  // namespace tilepress
