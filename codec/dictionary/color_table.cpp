// Colour table: building, writing and reading.
#include "dictionary/color_table.h"

#include <algorithm>
#include <cassert>

namespace tilepress {

void write_colors(std::span<const uint32_t> colors, uint32_t slots, uint32_t pixel_bits, BitWriter& out) {
  for (uint32_t i = 0; i < slots; ++i) {
    out.put(i < colors.size(), 1);
    out.put(i < colors.size() ? colors[i] : 0, pixel_bits);
  }
}

void ColorTable::assign(uint32_t slots, std::span<const uint32_t> colors) {
  assert(std::has_single_bit(slots) && slots <= kMostColors && colors.size() <= slots);
  slots_ = slots;
  colors_.assign(colors.begin(), colors.end());
  const uint32_t size = std::max(4u, slots * 4);
  mask_ = size - 1;
  shift_ = 33 - static_cast<uint32_t>(std::bit_width(size));
  keys_.assign(size, 0);
  indices_.assign(size, kNoColor);
  for (uint32_t i = 0; i < colors_.size(); ++i) {
    uint32_t at = colors_[i] * 0x9E3779B1u >> shift_;
    while (indices_[at] != kNoColor) at = (at + 1) & mask_;
    keys_[at] = colors_[i];
    indices_[at] = static_cast<uint16_t>(i);
  }
}

bool ColorTable::read(BitReader& in, uint64_t slots, uint32_t pixel_bits) {
  if (!std::has_single_bit(slots) || slots > kMostColors) return false;
  slots_ = static_cast<uint32_t>(slots);
  colors_.clear();
  bool ended = false;
  for (uint32_t i = 0; i < slots_; ++i) {
    const bool valid = in.get(1) != 0;
    const auto color = static_cast<uint32_t>(in.get(pixel_bits));
    if (valid && ended) return false;
    if (valid)
      colors_.push_back(color);
    else
      ended = true;
  }
  return !in.overran();
}

}  // namespace tilepress
