// Common Colors Dictionary: built from an FVC, looked up by colour, written and read back.
#include "dcp/ccd.h"

#include <algorithm>

#include "dcp/fvc.h"

namespace tilepress {

void Ccd::build(const Fvc& fvc) {
  entries = fvc.slots();
  std::array<uint16_t, 1024> order;
  uint32_t valid = 0;
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot)
    if (fvc.valid(slot)) order[valid++] = static_cast<uint16_t>(slot);
  std::sort(order.begin(), order.begin() + valid, [&](uint16_t a, uint16_t b) {
    return fvc.count(a) != fvc.count(b) ? fvc.count(a) > fvc.count(b) : a < b;
  });
  colors.clear();
  counts.clear();
  for (uint32_t i = 0; i < valid; ++i) {
    colors.push_back(fvc.color(order[i]));
    counts.push_back(fvc.count(order[i]));
  }
  samples = fvc.samples();
  coverage = fvc.coverage();
}

void CcdLookup::build(const Ccd& ccd) {
  const uint32_t size = std::max(16u, ccd.entries * 4);  // at most a quarter full: short probes
  mask_ = size - 1;
  shift_ = 33 - static_cast<uint32_t>(std::bit_width(size));
  colors_.assign(size, 0);
  indices_.assign(size, kNotInCcd);
  for (size_t i = 0; i < ccd.colors.size(); ++i) {
    uint32_t at = hash(ccd.colors[i]);
    while (indices_[at] != kNotInCcd) at = (at + 1) & mask_;
    colors_[at] = ccd.colors[i];
    indices_[at] = static_cast<uint16_t>(i);
  }
}

void CcdLookup::find_block(const Block& block, std::array<uint16_t, kBlockPixels>& indices) const {
  uint32_t last_color = block.pixels[0];
  uint16_t last_index = find(last_color);
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    if (block.pixels[i] != last_color) {
      last_color = block.pixels[i];
      last_index = find(last_color);
    }
    indices[i] = last_index;
  }
}

void Rccd::write(const Ccd& ccd, uint32_t slots, uint32_t pixel_bits, BitWriter& out) {
  for (uint32_t i = 0; i < slots; ++i) {
    const bool valid = i < ccd.colors.size();
    out.put(valid ? 1 : 0, 1);
    out.put(valid ? ccd.colors[i] : 0, pixel_bits);
  }
}

bool Rccd::read(BitReader& in, uint64_t slot_count, uint32_t pixel_bits) {
  if (!std::has_single_bit(slot_count) || slot_count > 1024) return false;
  slots = static_cast<uint32_t>(slot_count);
  colors.clear();
  bool ended = false;
  for (uint32_t i = 0; i < slots; ++i) {
    const bool valid = in.get(1) != 0;
    const auto color = static_cast<uint32_t>(in.get(pixel_bits));
    if (valid && ended) return false;
    if (valid)
      colors.push_back(color);
    else
      ended = true;
  }
  return !in.overran();
}

}  // namespace tilepress
