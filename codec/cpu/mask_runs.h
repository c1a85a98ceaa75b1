// Mask runs: a mask of where runs begin, run by run.
#pragma once

#include <bit>
#include <cstdint>

namespace tilepress {

/// visit(first, length) for each run: bit i of `begins`, which is not 0, says that one begins at i, and the
/// last ends before `end`.
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
