// Slot table: up to 64 colours by number, laid out so that byte permutes find 64 pixels at once.
#pragma once

#include <array>
#include <cstdint>

#include "tilepress/block.h"

namespace tilepress {

/// A block's pixels in traversal order, taken apart into bytes, and the buckets where a slot table looks for
/// each.
struct BlockKeys {
  alignas(64) uint8_t bytes[4][kBlockPixels];    ///< byte c of pixel i
  alignas(64) uint8_t buckets[2][kBlockPixels];  ///< the top bit is of no meaning

  static constexpr uint32_t kMultipliers[2] = {0x9E3779B1u, 0x85EBCA77u};
  static constexpr uint8_t bucket(uint32_t color, uint32_t which) {
    return static_cast<uint8_t>(color * kMultipliers[which] >> 24);
  }
  void fill(const uint32_t* pixels) {
    for (uint32_t i = 0; i < kBlockPixels; ++i) {
      for (uint32_t c = 0; c < 4; ++c) bytes[c][i] = static_cast<uint8_t>(pixels[i] >> 8 * c);
      for (uint32_t which = 0; which < 2; ++which) buckets[which][i] = bucket(pixels[i], which);
    }
  }
};

/// A cuckoo hash table: a colour lies in one of two buckets, which hold its slot number. A colour that finds
/// no bucket is stashed, and compared with every pixel.
class SlotTable {
 public:
  static constexpr uint32_t kSlots = 64, kBuckets = 128;
  static constexpr uint8_t kEmpty = 0x80;   ///< in a bucket
  static constexpr uint8_t kAbsent = 0x40;  ///< the slot of a colour that has none

  SlotTable() { clear(); }
  void clear();
  /// The colour is in no slot yet, and the slot is free.
  void insert(uint32_t slot, uint32_t color);
  /// Precondition: the slot holds a colour.
  void remove(uint32_t slot);
  /// The colour's slot, or kAbsent.
  uint32_t find(uint32_t color) const;

  // The layout, for the kernels.
  alignas(64) uint8_t buckets[2][kBuckets];
  alignas(64) uint8_t bytes[4][kSlots];  ///< byte c of the colour in each slot
  std::array<uint32_t, kSlots> colors;
  uint64_t stashed = 0;  ///< bit per slot

 private:
  uint8_t& bucket_of(uint32_t color, uint32_t which) {
    return buckets[which][BlockKeys::bucket(color, which) % kBuckets];
  }
  void place(uint32_t slot);
};

}  // namespace tilepress
