// Algorithm 1: predicts the CCD size that moves the fewest bits (paper §Adaptive DCP).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace tilepress {

/// Returns i for a CCD of 2^i entries, or 0 if no size saves bits. `counts` are the FVC counts in descending
/// order, `frame_pixels` the pixels sampled, and `max_width` is log2 N. The loop runs i = 0 … log2 N, one
/// step more than the paper's text says. Calls note(i, covered pixels, bits) in each step.
template <class Note>
uint32_t optimal_width(std::span<const uint32_t> counts, uint64_t frame_pixels, uint32_t max_width,
                       uint32_t pixel_bits, const Note& note) {
  uint64_t expected_bits = frame_pixels * pixel_bits;
  uint32_t best = 0;
  uint64_t sum = 0;
  size_t summed = 0;
  for (uint32_t i = 0; i <= max_width; ++i) {
    for (const size_t end = std::min<size_t>(size_t{1} << i, counts.size()); summed < end; ++summed)
      sum += counts[summed];
    const uint64_t bits = sum * i + (frame_pixels - sum) * pixel_bits;
    note(i, sum, bits);
    if (bits < expected_bits) {
      expected_bits = bits;
      best = i;
    }
  }
  return best;
}
inline uint32_t optimal_width(std::span<const uint32_t> counts, uint64_t frame_pixels, uint32_t max_width,
                              uint32_t pixel_bits) {
  return optimal_width(counts, frame_pixels, max_width, pixel_bits, [](uint32_t, uint64_t, uint64_t) {});
}

}  // namespace tilepress
