// Common Colors Dictionary: built from an FVC, and looked up by colour.
#include "dcp/ccd.h"

#include <algorithm>

#include "dcp/fvc.h"
#include "dcp/probe_kernels.h"
#include "dcp/slot_kernels.h"

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
  collision_free_ = false;
  has_slots_ = slot_table_pays(ccd.entries);
  if (has_slots_) {
    slots_.clear();
    for (uint32_t i = 0; i < ccd.colors.size(); ++i) slots_.insert(i, ccd.colors[i]);
    return;
  }
  constexpr uint32_t kTries = 64;
  const uint32_t buckets = std::max(16u, ccd.entries * (ccd.entries <= 128 ? 32 : 64));
  for (uint32_t n = 0; n < kTries && !collision_free_ && ccd.entries <= 512; ++n) {
    table_.multiplier = ProbeTable::multiplier_of(n);
    table_.reset(buckets, true);
    collision_free_ = place_all(ccd, false);
  }
  if (collision_free_) return;
  table_.multiplier = ProbeTable::multiplier_of(0);
  table_.reset(ccd.entries * 4, true);  // at most a quarter full: short probes
  place_all(ccd, true);
}

bool CcdLookup::place_all(const Ccd& ccd, bool probing) {
  std::fill(table_.values.begin(), table_.values.end(), uint32_t{kNotInCcd});
  for (size_t i = 0; i < ccd.colors.size(); ++i) {
    uint32_t at = table_.bucket(ccd.colors[i]);
    while (table_.values[at] != kNotInCcd) {
      if (!probing) return false;
      at = (at + 1) & (table_.size() - 1);
    }
    table_.colors[at] = ccd.colors[i];
    table_.values[at] = static_cast<uint32_t>(i);
  }
  return true;
}

void CcdLookup::find_block(const uint32_t* pixels, uint16_t* indices, uint8_t* widths) const {
  if (has_slots_) return slot_kernels().index(pixels, slots_, indices, widths);
  if (collision_free_) return probe_kernels().find(pixels, table_, indices, widths);
  uint32_t last_color = pixels[0];
  uint16_t last_index = find(last_color);
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    if (pixels[i] != last_color) {
      last_color = pixels[i];
      last_index = find(last_color);
    }
    indices[i] = last_index;
  }
  fill_widths(indices, widths);
}

void CcdLookup::find_block(const uint32_t* pixels, const FewColors& few, uint16_t* indices,
                           uint8_t* widths) const {
  uint32_t found[FewColors::kMost];
  for (uint32_t n = 0; n < few.count; ++n) found[n] = find(few.colors[n]);
  probe_kernels().find_few(pixels, few, found, indices, widths);
}

}  // namespace tilepress
