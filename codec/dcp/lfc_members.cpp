// LFC members: insertion, removal and look-up.
#include "dcp/lfc_members.h"

#include <algorithm>

#include "pixels/pixel_kernels.h"

namespace tilepress {

void SlotMembers::clear() {
  table_.clear();
  counts_.clear();
  std::fill_n(counts_.copy(0), SlotTable::kSlots, PlaceCounts::kNone);
}

ProbeMembers::ProbeMembers(uint32_t entries)
    : counts_(entries * 16 + 1 + kMaxCrowded), slot_places_(entries), slot_colors_(entries) {
  table_.multiplier = ProbeTable::multiplier_of(0);
  table_.reset(entries * 16, false);
  clear();
}

void ProbeMembers::clear() {
  table_.reset(table_.size(), false);
  counts_.clear();
  std::fill(slot_places_.begin(), slot_places_.end(), kNoPlace);
  crowded_ = 0;
}

uint32_t ProbeMembers::place_of(uint32_t color) const {
  const uint32_t bucket = table_.bucket(color);
  if (table_.colors[bucket] == color) return bucket;
  for (uint32_t i = 0; i < crowded_; ++i)
    if (crowded_colors_[i] == color) return crowded_place(i);
  return outside();
}

void ProbeMembers::insert(uint32_t slot, uint32_t color, uint32_t count) {
  uint32_t place = table_.bucket(color);
  if (table_.colors[place] == table_.filler(place)) {
    table_.colors[place] = color;
  } else {
    if (crowded_ == kMaxCrowded) {
      rehash();
      return insert(slot, color, count);
    }
    place = crowded_place(crowded_);
    crowded_colors_[crowded_] = color;
    crowded_slots_[crowded_++] = slot;
  }
  counts_.set(place, count);
  slot_places_[slot] = place;
  slot_colors_[slot] = color;
}

void ProbeMembers::remove(uint32_t slot) {
  const uint32_t place = slot_places_[slot];
  slot_places_[slot] = kNoPlace;
  if (place < table_.size()) {
    table_.colors[place] = table_.filler(place);
    return;
  }
  const uint32_t i = place - crowded_place(0), last = --crowded_;
  if (i == last) return;
  crowded_colors_[i] = crowded_colors_[last];
  crowded_slots_[i] = crowded_slots_[last];
  counts_.set(place, counts_.at(crowded_place(last)));
  slot_places_[crowded_slots_[i]] = place;
}

/// Takes another multiplier, and inserts every member anew.
void ProbeMembers::rehash() {
  std::array<uint32_t, kMost> counts{};
  const auto slots = static_cast<uint32_t>(slot_places_.size());
  const auto is_member = [&](uint32_t slot) { return slot_places_[slot] != kNoPlace; };
  for (uint32_t slot = 0; slot < slots; ++slot)
    if (is_member(slot)) counts[slot] = count(slot);
  for (bool fits = false; !fits;) {
    table_.multiplier = ProbeTable::multiplier_of(++multiplier_index_);
    table_.reset(table_.size(), false);
    uint32_t collisions = 0;
    for (uint32_t slot = 0; slot < slots; ++slot) {
      if (!is_member(slot)) continue;
      const uint32_t bucket = table_.bucket(slot_colors_[slot]);
      collisions += table_.colors[bucket] != table_.filler(bucket);
      table_.colors[bucket] = slot_colors_[slot];
    }
    fits = collisions < kMaxCrowded;
  }
  table_.reset(table_.size(), false);
  crowded_ = 0;
  for (uint32_t slot = 0; slot < slots; ++slot)
    if (is_member(slot)) insert(slot, slot_colors_[slot], counts[slot]);
}

Smallest ProbeMembers::find_smallest() const {
  Smallest found = {0, PlaceCounts::kNone, PlaceCounts::kNone};
  for (uint32_t slot = 0; slot < slot_places_.size(); ++slot) {
    if (slot_places_[slot] == kNoPlace) continue;
    const uint32_t each = count(slot);
    if (each < found.smallest)
      found = {slot, each, found.smallest};
    else
      found.second = std::min(found.second, each);
  }
  return found;
}

FoundSlots ProbeMembers::find(const uint32_t* pixels) {
  const uint64_t known =
      probe_kernels().members(pixels, table_, crowded_colors_.data(), crowded_, places_.data());
  return {known, known == 0 ? pixel_kernels().run_begins(pixels) : ~uint64_t{0}};
}

}  // namespace tilepress
