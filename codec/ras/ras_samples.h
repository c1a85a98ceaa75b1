// RAS samples: four planes of a block, interleaved, with a border that makes the prediction rule uniform.
#pragma once

#include <cstdint>
#include <cstring>

#include "tilepress/block.h"
#include "tilepress/pixel_format.h"

namespace tilepress {

/// Samples are int16, pixel (x, y) plane c at ras_sample_index(x, y) + c, for x and y from -1 to 7.
constexpr int32_t kRasRowSamples = 40;
constexpr int32_t kRasSamples = 9 * kRasRowSamples;
constexpr int32_t ras_sample_index(int32_t x, int32_t y) {
  return (y + 1) * kRasRowSamples + (x + 1) * 4;
}

/// Fills the border. The median of equal neighbours is that neighbour whatever the third is, so: above row 0
/// lies the left neighbour, left of column 0 the upper one, and pixel (0, 0) is its own neighbour: residual
/// 0.
inline void fill_ras_border(int16_t* samples) {
  const auto copy = [&](int32_t tx, int32_t ty, int32_t sx, int32_t sy) {
    std::memcpy(samples + ras_sample_index(tx, ty), samples + ras_sample_index(sx, sy), 4 * sizeof(int16_t));
  };
  copy(-1, -1, 0, 0);
  copy(0, -1, 0, 0);
  copy(-1, 0, 0, 0);
  for (int32_t i = 1; i < 8; ++i) {
    copy(i, -1, i - 1, 0);
    copy(-1, i, 0, i - 1);
  }
}

}  // namespace tilepress
