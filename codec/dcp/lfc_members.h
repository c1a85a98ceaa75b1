// LFC members: the colours of all slots but the tail, with their counts, looked up a block at a time.
//
// LfcCollector works with either class. A place is where a colour's count is: `outside()` for colours that
// are no members. find() fills places() for a block.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dcp/probe_kernels.h"
#include "dcp/slot_kernels.h"

namespace tilepress {

/// Counts by place, in four copies that are summed when needed: adding to one address again and again would
/// wait for the store before.
class PlaceCounts {
 public:
  static constexpr uint32_t kNone = 0xFFFFFFFF;  ///< of a slot without a member
  explicit PlaceCounts(uint32_t places) : stride_(places), counts_(size_t{places} * 4) {}
  void clear() { std::fill(counts_.begin(), counts_.end(), 0u); }
  uint32_t at(uint32_t place) const {
    return counts_[place] + counts_[place + stride_] + counts_[place + 2 * stride_] +
           counts_[place + 3 * stride_];
  }
  void set(uint32_t place, uint32_t count) {
    for (uint32_t copy = 0; copy < 4; ++copy) counts_[place + copy * stride_] = copy == 0 ? count : 0;
  }
  uint32_t* copy(uint32_t number) { return &counts_[size_t{number} * stride_]; }
  Smallest smallest_of_64() const { return probe_kernels().find_smallest(counts_.data(), stride_); }

 private:
  uint32_t stride_;
  std::vector<uint32_t> counts_;
};

/// Up to 64 members in a slot table, for processors with byte permutes. A member's place is its slot.
class SlotMembers {
 public:
  using Place = uint8_t;
  explicit SlotMembers(uint32_t) { clear(); }
  void clear();
  uint32_t place_of(uint32_t color) const { return table_.find(color); }
  uint32_t outside() const { return SlotTable::kAbsent; }
  uint32_t color(uint32_t slot) const { return table_.colors[slot]; }
  uint32_t count(uint32_t slot) const { return counts_.at(slot); }
  void insert(uint32_t slot, uint32_t color, uint32_t count) {
    table_.insert(slot, color);
    counts_.set(slot, count);
  }
  void remove(uint32_t slot) {
    table_.remove(slot);
    counts_.set(slot, PlaceCounts::kNone);
  }
  Smallest find_smallest() const { return counts_.smallest_of_64(); }
  FoundSlots find(const uint32_t* pixels) {
    return lookup_.found = slot_kernels().find(pixels, table_, lookup_.slots);
  }
  const Place* places() const { return lookup_.slots; }
  PlaceCounts& counts() { return counts_; }
  /// Counts hits of a few colours. Returns the hits left.
  uint64_t count_few(uint64_t hits) { return slot_kernels().count(lookup_.slots, hits, counts_.copy(0)); }
  MemberLookup* lookup() { return &lookup_; }

 private:
  SlotTable table_;
  MemberLookup lookup_{.table = &table_, .found = {}, .slots = {}};
  PlaceCounts counts_{SlotTable::kAbsent + 1};
};

/// Up to 128 members in a hash table without probing. A member's place is its bucket, or one of a few places
/// for colours whose bucket was taken.
class ProbeMembers {
 public:
  static constexpr uint32_t kMost = 128;  ///< beyond, collisions in the table would become common
  using Place = uint32_t;
  explicit ProbeMembers(uint32_t entries);
  void clear();
  uint32_t place_of(uint32_t color) const;
  uint32_t outside() const { return table_.size(); }
  uint32_t color(uint32_t slot) const { return slot_colors_[slot]; }
  uint32_t count(uint32_t slot) const { return counts_.at(slot_places_[slot]); }
  void insert(uint32_t slot, uint32_t color, uint32_t count);
  void remove(uint32_t slot);
  Smallest find_smallest() const;
  FoundSlots find(const uint32_t* pixels);
  const Place* places() const { return places_.data(); }
  PlaceCounts& counts() { return counts_; }
  uint64_t count_few(uint64_t hits) { return hits; }
  MemberLookup* lookup() { return nullptr; }

 private:
  static constexpr uint32_t kMaxCrowded = 8, kNoPlace = 0xFFFFFFFF;
  uint32_t crowded_place(uint32_t i) const { return table_.size() + 1 + i; }
  void rehash();

  ProbeTable table_;      ///< all members but the crowded ones
  uint32_t crowded_ = 0;  ///< members whose bucket was taken
  std::array<uint32_t, kMaxCrowded> crowded_colors_{}, crowded_slots_{};
  uint32_t multiplier_index_ = 0;
  PlaceCounts counts_;
  std::vector<uint32_t> slot_places_, slot_colors_;
  std::array<Place, kBlockPixels> places_;
};

}  // namespace tilepress
