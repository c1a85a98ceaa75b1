// RAS kernels, plainly: the rules of prediction and codes.
#include "ras/ras_kernels.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace tilepress {
namespace {

/// Predicts a pixel from its left neighbour `a`, its upper one `b` and the upper left one `c`.
int32_t median_edge(int32_t a, int32_t b, int32_t c) {
  if (c >= std::max(a, b)) return std::min(a, b);
  if (c <= std::min(a, b)) return std::max(a, b);
  return a + b - c;
}

/// Chooses the k of a group and returns the bits of its code, header included. `begin` is 1 in the group of
/// the first pixel, which has no residual, and 0 elsewhere.
void choose_code(const RasGroups& groups, uint32_t at, uint32_t begin, uint16_t& k, uint64_t& length) {
  uint32_t any = 0;
  for (uint32_t i = 0; i < 4; ++i) any |= groups.residuals[i][at];
  k = kRasZeroGroup;
  length = 3;
  if (any == 0) return;
  length = ~uint64_t{0};
  for (uint16_t candidate = 0; candidate <= kRasLargestK; ++candidate) {
    uint64_t bits = 3;
    for (uint32_t i = begin; i < 4; ++i) bits += (groups.residuals[i][at] >> candidate) + 1u + candidate;
    if (bits >= length) continue;
    length = bits;
    k = candidate;
  }
}

void write_groups(const int16_t* samples, RasGroups& groups) {
  for (uint32_t group = 0; group < kSubBlocks; ++group)
    for (uint32_t plane = 0; plane < 4; ++plane) {
      const uint32_t at = ras_group_index(plane, group), begin = group == 0 ? 1 : 0;
      for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t x = kTraversal[4 * group + i] % 8, y = kTraversal[4 * group + i] / 8;
        const int16_t* sample = samples + ras_sample_index(x, y) + plane;
        const int32_t e =
            sample[0] - median_edge(sample[-4], sample[-kRasRowSamples], sample[-kRasRowSamples - 4]);
        groups.residuals[i][at] = static_cast<uint16_t>(e >= 0 ? 2 * e : -2 * e - 1);
      }
      uint16_t& k = groups.k[at];
      uint64_t& length = groups.lengths[at];
      choose_code(groups, at, begin, k, length);
      uint64_t& code = groups.codes[at];
      code = k;
      if (k == kRasZeroGroup || length > kMaxBitsPerCall) continue;
      for (uint32_t i = begin; i < 4; ++i) {
        const uint32_t u = groups.residuals[i][at], ones = u >> k;
        code = (code << ones | ((uint64_t{1} << ones) - 1)) << 1;
        code = code << k | (u & ((1u << k) - 1));
      }
    }
}

uint32_t code_bits(const int16_t* samples) {
  RasGroups groups;
  write_groups(samples, groups);
  return static_cast<uint32_t>(
      std::accumulate(std::begin(groups.lengths), std::end(groups.lengths), uint64_t{0}));
}

void restore(int16_t* samples) {
  constexpr int32_t kRow = 4 * kBlockSide;
  for (int32_t i = 4; i < 4 * static_cast<int32_t>(kBlockPixels); ++i) {
    int16_t* at = samples + i;
    const int32_t prediction = i < kRow       ? at[-4]
                               : i % kRow < 4 ? at[-kRow]
                                              : median_edge(at[-4], at[-kRow], at[-kRow - 4]);
    *at = static_cast<int16_t>(*at + prediction);
  }
}

bool narrow_bytes(const int16_t* samples, uint32_t* pixels) {
  uint32_t beyond = 0;
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    pixels[i] = 0;
    for (uint32_t c = 0; c < 4; ++c) {
      const auto sample = static_cast<uint16_t>(samples[4 * i + c]);
      beyond |= sample >> 8;
      pixels[i] |= (sample & 0xFFu) << (8 * c);
    }
  }
  return beyond == 0;
}

void widen_bytes(const uint32_t* top_left, uint32_t stride, int16_t* samples) {
  for (uint32_t y = 0; y < kBlockSide; ++y)
    for (uint32_t x = 0; x < kBlockSide; ++x)
      for (uint32_t c = 0; c < 4; ++c)
        samples[ras_sample_index(x, y) + c] =
            static_cast<int16_t>(top_left[y * stride + x] >> (8 * c) & 0xFF);
}

}  // namespace

constexpr RasKernels kPlainRasKernels = {.widen_bytes = widen_bytes,
                                         .code_bits = code_bits,
                                         .groups = write_groups,
                                         .restore = restore,
                                         .narrow_bytes = narrow_bytes};

}  // namespace tilepress
