// Probe table: finds a colour in a small set with one multiplication, one shift and one comparison.
#pragma once

#include <cstdint>
#include <vector>

namespace tilepress {

/// A hash table without probing: a colour is in its own bucket or not in the table. An empty bucket holds a
/// colour of another bucket, so that a lookup needs no validity test.
struct ProbeTable {
  std::vector<uint32_t> colors;
  std::vector<uint32_t> values;  ///< empty if only membership matters
  uint32_t multiplier = 0x9E3779B1u;
  uint32_t shift = 31;

  uint32_t bucket(uint32_t color) const { return (color * multiplier) >> shift; }
  uint32_t size() const { return static_cast<uint32_t>(colors.size()); }
  bool holds(uint32_t color) const { return colors[bucket(color)] == color; }

  /// Empties a table of `size` buckets (a power of two ≥ 2).
  void reset(uint32_t size, bool with_values) {
    shift = 32;
    for (uint32_t s = size; s > 1; s >>= 1) --shift;
    colors.assign(size, 0);
    values.assign(with_values ? size : 0, 0);
    colors[0] = filler(0);
  }
  /// Returns the colour of an empty bucket. Colour 0 belongs to bucket 0, so it marks all other buckets.
  uint32_t filler(uint32_t at) const {
    if (at != 0) return 0;
    uint32_t color = 1;
    while (bucket(color) == 0) ++color;
    return color;
  }
  /// Returns the n-th of a fixed series of odd multipliers.
  static uint32_t multiplier_of(uint32_t n) {
    uint32_t x = (n + 1) * 0x9E3779B9u;
    x = (x ^ (x >> 16)) * 0x85EBCA6Bu;
    x = (x ^ (x >> 13)) * 0xC2B2AE35u;
    return (x ^ (x >> 16)) | 1u;
  }
};

}  // namespace tilepress
