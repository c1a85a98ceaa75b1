// Kernel targets: runs a comparison on every instruction set of this machine; and blocks to compare.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "surface_patterns.h"
#include "tilepress/block.h"
#include "tilepress/simd.h"

namespace patterns {

using BlockPixels = std::array<uint32_t, tilepress::kBlockPixels>;

/// Calls check() with each target in force, and restores the target in force before. A fatal failure ends it.
template <class Check>
void on_every_target(const Check& check) {
  const std::string before(tilepress::simd_target());
  for (const std::string_view each : tilepress::simd_targets()) {
    SCOPED_TRACE(each);
    tilepress::force_simd_target(each);
    check();
    if (testing::Test::HasFatalFailure()) break;
  }
  tilepress::force_simd_target(before);
}

/// 64 pixels of one of `colors` colours each, in runs of up to `longest_run`.
inline BlockPixels draw_block(uint32_t colors, uint32_t longest_run, Dice& dice) {
  BlockPixels pixels;
  for (uint32_t i = 0; i < tilepress::kBlockPixels;) {
    // Squared: some colours far more often than others.
    const uint64_t at = dice.below(1u << 16), color = at * at % (uint64_t{colors} << 16) >> 16;
    for (uint32_t run = 1 + dice.below(longest_run); run > 0 && i < tilepress::kBlockPixels; --run)
      pixels[i++] = static_cast<uint32_t>(color) * 0x01000193u;
  }
  return pixels;
}

}  // namespace patterns
