// Huffman codes over a dictionary: lengths by the rule of spec §5, canonical codes, decoding by a table.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tilepress/bit_io.h"

namespace tilepress {

/// Longest code there can be: counts below 2^32 force a depth under 47 (a depth d needs counts that sum to at
/// least the d-th Fibonacci number). A stored length takes 6 bits.
constexpr uint32_t kMaxHuffmanLength = 47;

/// Code lengths by index: one per count, at most 1024 of them. Joins repeatedly the two nodes of smallest
/// (count, id), the new node taking the next id; one symbol alone gets 1 bit.
void huffman_lengths(std::span<const uint32_t> counts, std::vector<uint8_t>& lengths);
inline std::vector<uint8_t> huffman_lengths(std::span<const uint32_t> counts) {
  std::vector<uint8_t> lengths;
  huffman_lengths(counts, lengths);
  return lengths;
}

/// Canonical code: shorter codes first, equal lengths by index.
class CanonicalCode {
 public:
  /// False if the lengths do not form a prefix code (or a length is over kMaxHuffmanLength); then there is no
  /// code.
  bool assign(std::span<const uint8_t> lengths);
  uint64_t code(uint32_t index) const { return codes_[index]; }
  uint32_t length(uint32_t index) const { return lengths_[index]; }
  /// Reads one symbol. False: no code starts with these bits.
  bool read(BitReader& in, uint32_t& index) const {
    const uint64_t window = in.peek();
    const Entry entry = table_[window >> (64 - kTableBits)];
    index = entry.index;
    uint32_t length = entry.length;
    if (length == 0 && !find_long(window, index, length)) return false;
    in.skip(length);
    return true;
  }
  /// Reads four, as read() does.
  bool read_four(BitReader& in, uint32_t* indices) const {
    uint64_t window = in.peek();
    uint32_t taken = 0;
    for (uint32_t i = 0; i < 4; ++i) {
      const Entry entry = table_[window >> (64 - kTableBits)];
      if (entry.length == 0) {  // not often
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
  /// What a code of up to kTableBits bits stands for; length 0 where a longer one begins, or none.
  struct Entry {
    uint16_t index;
    uint8_t length;
  };
  /// The code at the top of `window` that the table does not hold.
  bool find_long(uint64_t window, uint32_t& index, uint32_t& length) const;
  bool try_assign(std::span<const uint8_t> lengths);
  std::vector<uint8_t> lengths_;
  std::vector<uint64_t> codes_;
  std::vector<uint16_t> ordered_;                ///< indices by (length, index)
  std::array<Entry, 1u << kTableBits> table_{};  ///< by the next bits
  std::array<uint64_t, kMaxHuffmanLength + 1> first_code_{};
  std::array<uint32_t, kMaxHuffmanLength + 1> first_rank_{}, count_{};
};

}  // namespace tilepress
