// Colour table: a dictionary of up to 1024 colours that is looked up both ways and travels with a frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tilepress/bit_io.h"

namespace tilepress {

constexpr uint32_t kNoColor = 0xFFFF;

/// Slots of a valid bit and a colour, so (pixel bits + 1) bits each: 33 for 32-bit pixels, as an rCCD has
/// them.
class ColorTable {
 public:
  /// `slots` is a power of two up to 1024 and at least colors.size(); the colours differ from each other.
  void assign(uint32_t slots, std::span<const uint32_t> colors);

  uint32_t slots() const { return slots_; }
  const std::vector<uint32_t>& colors() const { return colors_; }
  uint32_t index_bits() const;  ///< log2 slots
  uint64_t table_bits(uint32_t pixel_bits) const { return uint64_t{slots_} * (pixel_bits + 1); }
  /// Index of the colour, kNoColor if it has none.
  uint32_t find(uint32_t color) const {
    for (uint32_t at = color * 0x9E3779B1u >> shift_;; at = (at + 1) & mask_)
      if (indices_[at] == kNoColor || keys_[at] == color) return indices_[at];
  }

  void write(uint32_t pixel_bits, BitWriter& out) const;
  /// False if the number of slots is no power of two up to 1024, or a valid slot follows an invalid one. Only
  /// colors() and slots() may be used afterwards.
  bool read(BitReader& in, uint64_t slots, uint32_t pixel_bits);

 private:
  uint32_t slots_ = 0, mask_ = 0, shift_ = 31;
  std::vector<uint32_t> colors_;
  std::vector<uint32_t> keys_, indices_;  ///< open-addressed, at most a quarter full
};

}  // namespace tilepress
