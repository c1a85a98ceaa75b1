// Mask runs: visits runs whose beginnings are the set bits of a mask.
#pragma once

#include <bit>
#include <cstdint>

namespace tilepress {

/// Calls visit(first, length) for each run. A run begins at each set bit of `begins`, which is not 0. The
/// last run ends before `end`.
template <typename Visit>
void for_each_mask_run(uint64_t begins, uint32_t end, const Visit& visit) {
  while (true) {
    const auto first = static_cast<uint32_t>(std::countr_zero(begins));
    begins &= begins - 1;
    if (begins == 0) return visit(first, end - first);
    visit(first, static_cast<uint32_t>(std::countr_zero(begins)) - first);
  }
}

}  // namespace tilepress
