// RAS samples: four interleaved planes of a block with a border, and the codes of their groups. The border
// makes the prediction rule the same for every pixel.
#pragma once

#include <cstdint>
#include <cstring>

#include "tilepress/bit_io.h"
#include "tilepress/block.h"
#include "tilepress/pixel_format.h"

namespace tilepress {

/// Samples are int16, pixel (x, y) plane c at ras_sample_index(x, y) + c, for x and y from -1 to 7.
constexpr int32_t kRasRowSamples = 40;
/// Samples are between minus this and this: Co and Cg of 10-bit channels take 11 bits.
constexpr int32_t kRasMostSample = 2048;
constexpr int32_t kRasSamples = 9 * kRasRowSamples;
constexpr int32_t ras_sample_index(int32_t x, int32_t y) {
  return (y + 1) * kRasRowSamples + (x + 1) * 4;
}

constexpr uint16_t kRasZeroGroup = 7;  ///< the "special mode" of k
constexpr uint16_t kRasLargestK = 6;

/// The codes of a block of four planes. Each array has ras_group_index(plane, group) as its index.
struct RasGroups {
  alignas(64) uint16_t residuals[4][4 * kSubBlocks];  ///< folded, in the order of the group's pixels
  alignas(64) uint16_t k[4 * kSubBlocks];
  alignas(64) uint64_t lengths[4 * kSubBlocks];  ///< bits of the group with its header
  alignas(64) uint64_t codes[4 * kSubBlocks];    ///< these bits; undefined if more than kMaxBitsPerCall
};
constexpr uint32_t ras_group_index(uint32_t plane, uint32_t group) {
  return group / 8 * 32 + group % 4 * 8 + group / 4 % 2 * 4 + plane;
}

/// Fills the border. The median edge of two equal neighbours is that neighbour, whatever the third is. So the
/// border above row 0 repeats the left neighbour, and the border left of column 0 the upper neighbour. Pixel
/// (0, 0) is its own neighbour, with residual 0.
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
