// Colour table: a dictionary of up to 1024 colours that travels with a frame, such as the paper's rCCD.
//
//   per slot    1 valid bit, then the colour: (pixel bits + 1) bits, 33 for 32-bit pixels
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "tilepress/bit_io.h"

namespace tilepress {

/// The index of a colour that a dictionary lacks.
constexpr uint16_t kNoColor = 0xFFFF;
constexpr uint32_t kMostColors = 1024;

/// Appends `slots` slots: the first colours of `colors`, then invalid slots.
void write_colors(std::span<const uint32_t> colors, uint32_t slots, uint32_t pixel_bits, BitWriter& out);

class ColorTable {
 public:
  /// `slots` is a power of two up to 1024 and at least colors.size(). The colours differ from each other.
  void assign(uint32_t slots, std::span<const uint32_t> colors);

  uint32_t slots() const { return slots_; }
  const std::vector<uint32_t>& colors() const { return colors_; }
  uint32_t index_bits() const { return static_cast<uint32_t>(std::bit_width(slots_) - 1); }  ///< log2 slots
  uint64_t table_bits(uint32_t pixel_bits) const { return uint64_t{slots_} * (pixel_bits + 1); }
  /// Returns the index of the colour, or kNoColor. Call assign() first.
  uint16_t find(uint32_t color) const {
    for (uint32_t at = color * 0x9E3779B1u >> shift_;; at = (at + 1) & mask_)
      if (indices_[at] == kNoColor || keys_[at] == color) return indices_[at];
  }

  void write(uint32_t pixel_bits, BitWriter& out) const { write_colors(colors_, slots_, pixel_bits, out); }
  /// Reads slots() and colors(); find() does not work afterwards. Returns false if the number of slots is not
  /// a power of two up to 1024, or a valid slot follows an invalid one.
  bool read(BitReader& in, uint64_t slots, uint32_t pixel_bits);

 private:
  uint32_t slots_ = 0, mask_ = 0, shift_ = 31;
  std::vector<uint32_t> colors_, keys_;
  std::vector<uint16_t> indices_;  ///< open-addressed as keys_, at most a quarter full
};

}  // namespace tilepress
