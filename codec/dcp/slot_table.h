// Slot table: up to 64 numbered colours, laid out for byte permutes that find 64 pixels at once.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "tilepress/block.h"

namespace tilepress {

/// The two buckets of a colour, below 128.
struct SlotBuckets {
  /// Bit i of a bucket is the parity of the colour's bits under mask i. Parity is linear: one product of bit
  /// matrices turns byte c of 64 pixels into its part of 64 buckets. These masks are the best of many random
  /// ones: two shades of the same channels never share both buckets.
  static constexpr uint32_t kMasks[2][7] = {
      {0xEB6D8D01, 0xE3A0DF1B, 0xAD1FCCFA, 0xE1D088C6, 0xFF07A961, 0xD0DF7527, 0xDB89973A},
      {0x09ADE6F2, 0xB3BCEAE9, 0xAA4CAED1, 0xAB6CB08B, 0xD6E5CE85, 0xD83D9B39, 0xEF979572}};
  static uint8_t of(uint32_t color, uint32_t which) {
    uint8_t bucket = 0;
    for (uint32_t c = 0; c < 4; ++c) bucket ^= kParts.of[which][c][color >> 8 * c & 0xFF];
    return bucket;
  }

 private:
  /// The part of a bucket for each value of byte c.
  struct Parts {
    uint8_t of[2][4][256];
    constexpr Parts() : of() {
      for (uint32_t which = 0; which < 2; ++which)
        for (uint32_t c = 0; c < 4; ++c)
          for (uint32_t value = 0; value < 256; ++value)
            for (uint32_t bit = 0; bit < 7; ++bit) {
              const bool odd = std::popcount(kMasks[which][bit] & value << 8 * c) % 2 == 1;
              of[which][c][value] = static_cast<uint8_t>(of[which][c][value] | odd << bit);
            }
    }
  };
  static const Parts kParts;
};

inline constexpr SlotBuckets::Parts SlotBuckets::kParts;

/// A cuckoo hash table: the slot number of a colour is in one of the colour's two buckets. A colour that
/// finds no bucket goes to the stash, and look-ups compare every pixel with it.
class SlotTable {
 public:
  static constexpr uint32_t kSlots = 64, kBuckets = 128;
  static constexpr uint8_t kEmpty = 0x80;   ///< in a bucket
  static constexpr uint8_t kAbsent = 0x40;  ///< the slot of a colour that has none

  SlotTable() { clear(); }
  void clear();
  /// Precondition: no slot holds the colour, and the slot is free.
  void insert(uint32_t slot, uint32_t color);
  /// Precondition: the slot holds a colour.
  void remove(uint32_t slot);
  /// Returns the slot of the colour, or kAbsent.
  uint32_t find(uint32_t color) const;

  // The layout, for the kernels.
  alignas(64) uint8_t buckets[2][kBuckets];
  alignas(64) uint8_t bytes[4][kSlots];  ///< byte c of the colour in each slot
  std::array<uint32_t, kSlots> colors;
  uint64_t stashed = 0;  ///< bit per slot

 private:
  uint8_t& bucket_of(uint32_t color, uint32_t which) { return buckets[which][SlotBuckets::of(color, which)]; }
  void place(uint32_t slot);
};

}  // namespace tilepress
