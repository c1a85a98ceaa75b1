// Colour buckets: a hash table of counts by colour, in which one comparison covers a whole bucket.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tilepress {

/// A line of memory. A colour is in its own bucket or, if that bucket was full, in the next one with room.
/// Bucket 0 belongs to colour 0 alone. In all other buckets colour 0 marks the empty places, which come last.
struct alignas(64) ColorBucket {
  static constexpr uint32_t kPlaces = 8;

  uint32_t colors[kPlaces];
  uint32_t counts[kPlaces];

  /// Returns the own bucket of a colour in a table of 2 to 2^32 `buckets`.
  static size_t of(uint32_t color, size_t buckets) {
    return (uint64_t{color * 0x9E3779B1u} * (buckets - 1) + 0xFFFFFFFF) >> 32;
  }
  /// Returns the first place of the colour, or kPlaces.
  uint32_t find(uint32_t color) const {
    uint32_t place = 0;
    while (place < kPlaces && colors[place] != color) ++place;
    return place;
  }
};

}  // namespace tilepress
