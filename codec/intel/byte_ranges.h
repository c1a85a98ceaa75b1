// Byte ranges: the smallest and the largest value of each byte over words, and the bits that hold the span.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace tilepress {

/// Byte c of a word has the values low[c] … high[c].
struct ByteRanges {
  std::array<uint8_t, 4> low, high;

  uint32_t span(uint32_t c) const { return high[c] - low[c]; }
  /// Returns the bits of a difference from low[c]; 0 if all values are equal.
  uint32_t width(uint32_t c) const { return static_cast<uint32_t>(std::bit_width(span(c))); }
};

inline ByteRanges united(const ByteRanges& a, const ByteRanges& b) {
  ByteRanges both;
  for (uint32_t c = 0; c < 4; ++c) {
    both.low[c] = std::min(a.low[c], b.low[c]);
    both.high[c] = std::max(a.high[c], b.high[c]);
  }
  return both;
}

/// Returns the ranges over 8 words at `a` and 8 words at `b`. Lanes of 16 bytes: compilers make one
/// instruction of each inner loop.
inline ByteRanges byte_ranges(const uint32_t* a, const uint32_t* b) {
  constexpr uint32_t kLanes = 16;
  uint8_t low[kLanes], high[kLanes];
  std::memcpy(low, a, kLanes);
  std::memcpy(high, a, kLanes);
  for (const uint32_t* words : {a + 4, b, b + 4}) {
    uint8_t bytes[kLanes];
    std::memcpy(bytes, words, kLanes);
    for (uint32_t i = 0; i < kLanes; ++i) low[i] = std::min(low[i], bytes[i]);
    for (uint32_t i = 0; i < kLanes; ++i) high[i] = std::max(high[i], bytes[i]);
  }
  uint32_t lows[4], highs[4];
  std::memcpy(lows, low, kLanes);
  std::memcpy(highs, high, kLanes);
  ByteRanges ranges;
  for (uint32_t c = 0; c < 4; ++c) {
    const auto byte = [&](uint32_t word) { return static_cast<uint8_t>(word >> 8 * c); };
    ranges.low[c] = std::min(std::min(byte(lows[0]), byte(lows[1])), std::min(byte(lows[2]), byte(lows[3])));
    ranges.high[c] =
        std::max(std::max(byte(highs[0]), byte(highs[1])), std::max(byte(highs[2]), byte(highs[3])));
  }
  return ranges;
}

}  // namespace tilepress
