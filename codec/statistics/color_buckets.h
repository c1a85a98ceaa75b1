// Color buckets: a hash table of counts by colour, laid out so that one comparison looks at a whole bucket.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tilepress {

/// A line of memory. A colour lies in its own bucket or, if that was full when it came, in the next that was
/// not. Bucket 0 is colour 0's alone, so that in all others colour 0 marks the empty places, the last ones.
struct alignas(64) ColorBucket {
  static constexpr uint32_t kPlaces = 8;

  uint32_t colors[kPlaces];
  uint32_t counts[kPlaces];

  /// The own bucket of a colour, in a table of `buckets`, 2 to 2^32.
  static size_t of(uint32_t color, size_t buckets) {
    return (uint64_t{color * 0x9E3779B1u} * (buckets - 1) + 0xFFFFFFFF) >> 32;
  }
  /// The first place of the colour, or kPlaces.
  uint32_t find(uint32_t color) const {
    uint32_t place = 0;
    while (place < kPlaces && colors[place] != color) ++place;
    return place;
  }
};

}  // namespace tilepress
