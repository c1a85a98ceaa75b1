// Replace words: a row's words one by one, as the kernel is defined, and for the end of a row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tilepress {

/// Words `begin` to `end` of a row; see Kernels::replace_row.
inline uint32_t replace_words(const std::byte* words, uint32_t begin, uint32_t end, bool swap_red_blue,
                              uint32_t set_bits, uint32_t* row, uint8_t* changed_blocks) {
  uint32_t changed = 0;
  for (uint32_t x = begin; x < end; ++x) {
    uint32_t word;
    std::memcpy(&word, words + size_t{x} * 4, 4);
    if (swap_red_blue) word = (word & 0xFF00FF00u) | (word >> 16 & 0xFFu) | (word & 0xFFu) << 16;
    word |= set_bits;
    if (row[x] == word) continue;
    row[x] = word;
    ++changed;
    if (changed_blocks != nullptr) changed_blocks[x / 8] = 1;
  }
  return changed;
}

}  // namespace tilepress
