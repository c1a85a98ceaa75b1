// Huffman codes over a dictionary: lengths by Huffman's rule, canonical codes, decoding by a table.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tilepress/bit_io.h"

namespace tilepress {

/// Longest code possible with counts below 2^32: a depth d needs counts that sum to at least the d-th
/// Fibonacci number. A stored length takes 6 bits.
constexpr uint32_t kMaxHuffmanLength = 47;

/// Returns one code length per count, for at most 1025 counts. Joins the two nodes of smallest (count, id)
/// again and again; the new node takes the next id. A single symbol has 1 bit.
void huffman_lengths(std::span<const uint32_t> counts, std::vector<uint8_t>& lengths);
inline std::vector<uint8_t> huffman_lengths(std::span<const uint32_t> counts) {
  std::vector<uint8_t> lengths;
  huffman_lengths(counts, lengths);
  return lengths;
}

/// Canonical code: shorter codes first, equal lengths by index.
class CanonicalCode {
 public:
  /// Returns false, and leaves the code empty, if the lengths form no prefix code or one is over
  /// kMaxHuffmanLength.
  bool assign(std::span<const uint8_t> lengths);
  uint64_t code(uint32_t index) const { return codes_[index]; }
  uint32_t length(uint32_t index) const { return lengths_[index]; }
  /// Reads one symbol. Returns false if no code starts with these bits.
  bool read(BitReader& in, uint32_t& index) const {
    const uint64_t window = in.peek();
    const Entry entry = table_[window >> (64 - kTableBits)];
    index = entry.index;
    uint32_t length = entry.length;
    if (length == 0 && !find_long(window, index, length)) return false;
    in.skip(length);
    return true;
  }
  /// Reads four symbols like read().
  bool read_four(BitReader& in, uint32_t* indices) const {
    uint64_t window = in.peek();
    uint32_t taken = 0;
    for (uint32_t i = 0; i < 4; ++i) {
      const Entry entry = table_[window >> (64 - kTableBits)];
      if (entry.length == 0) {  // rare
        for (in.skip(taken); i < 4; ++i)
          if (!read(in, indices[i])) return false;
        return true;
      }
      indices[i] = entry.index;
      window <<= entry.length;
      taken += entry.length;
    }
    in.skip(taken);
    return true;
  }

 private:
  static constexpr uint32_t kTableBits = 9;
  static_assert(4 * kTableBits <= kMaxBitsPerCall);  // for read_four()
  /// The symbol of a code of up to kTableBits bits. Length 0: a longer code begins with these bits, or no
  /// code.
  struct Entry {
    uint16_t index;
    uint8_t length;
  };
  /// Finds a code longer than kTableBits at the top of `window`.
  bool find_long(uint64_t window, uint32_t& index, uint32_t& length) const;
  bool try_assign(std::span<const uint8_t> lengths);
  std::vector<uint8_t> lengths_;
  std::vector<uint64_t> codes_;
  std::vector<uint16_t> ordered_;                ///< indices by (length, index)
  std::array<Entry, 1u << kTableBits> table_{};  ///< by the next kTableBits bits
  std::array<uint64_t, kMaxHuffmanLength + 1> first_code_{};
  std::array<uint32_t, kMaxHuffmanLength + 1> first_rank_{}, count_{};
};

}  // namespace tilepress
