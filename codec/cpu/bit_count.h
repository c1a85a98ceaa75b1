// Bit count: the number of set bits of a word. std::popcount would call a function on baseline x86-64.
#pragma once

#include <cstdint>

namespace tilepress {

constexpr uint32_t bit_count(uint64_t word) {
  word -= word >> 1 & 0x5555555555555555u;
  word = (word & 0x3333333333333333u) + (word >> 2 & 0x3333333333333333u);
  word = (word + (word >> 4)) & 0x0F0F0F0F0F0F0F0Fu;
  return static_cast<uint32_t>(word * 0x0101010101010101u >> 56);
}

}  // namespace tilepress
