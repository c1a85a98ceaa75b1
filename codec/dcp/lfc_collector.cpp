// LFC collector: see the header for why this equals the plain FVC.
#include "dcp/lfc_collector.h"

#include <algorithm>
#include <bit>

#include "dcp/fvc.h"
#include "simd/bit_count.h"
#include "simd/kernels.h"

namespace tilepress {
namespace {
constexpr uint32_t kBucketsPerEntry = 16;
constexpr uint32_t kFewHits = 24;  ///< so few are counted one by one; of more, all lanes without a branch
}  // namespace

LfcCollector::LfcCollector(uint32_t entries)
    : entries_(entries), slot_places_(entries, kNoSlot), slot_colors_(entries) {
  table_.multiplier = ProbeTable::multiplier_of(0);
  table_.reset(entries * kBucketsPerEntry, false);
  copy_stride_ = table_.size() + 1 + kMaxCrowded;
  counts_.assign(size_t{copy_stride_} * 4, 0);
}

void LfcCollector::reset() {
  table_.reset(table_.size(), false);
  std::fill(counts_.begin(), counts_.end(), 0u);
  std::fill(slot_places_.begin(), slot_places_.end(), kNoSlot);
  used_ = crowded_ = 0;
  samples_ = 0;
  floor_ = 0;
}

uint32_t LfcCollector::place_of(uint32_t color) const {
  const uint32_t bucket = table_.bucket(color);
  if (table_.colors[bucket] == color) return bucket;
  for (uint32_t i = 0; i < crowded_; ++i)
    if (crowded_colors_[i] == color) return crowded_place(i);
  return outside();
}

uint32_t LfcCollector::count_at(uint32_t place) const {
  return counts_[place] + counts_[place + copy_stride_] + counts_[place + 2 * copy_stride_] +
         counts_[place + 3 * copy_stride_];
}

void LfcCollector::add_member(uint32_t slot, uint32_t color, uint32_t count) {
  const uint32_t bucket = table_.bucket(color);
  uint32_t place = bucket;
  if (table_.colors[bucket] == table_.filler(bucket)) {
    table_.colors[bucket] = color;
  } else {
    if (crowded_ == kMaxCrowded) {
      rehash();
      return add_member(slot, color, count);
    }
    place = crowded_place(crowded_);
    crowded_colors_[crowded_] = color;
    crowded_slots_[crowded_++] = slot;
  }
  for (uint32_t copy = 0; copy < 4; ++copy) counts_[place + copy * copy_stride_] = 0;
  counts_[place] = count;
  slot_places_[slot] = place;
  slot_colors_[slot] = color;
}

void LfcCollector::remove_member(uint32_t slot) {
  const uint32_t place = slot_places_[slot];
  slot_places_[slot] = kNoSlot;
  if (place < table_.size()) {
    table_.colors[place] = table_.filler(place);
    return;
  }
  const uint32_t i = place - crowded_place(0), last = --crowded_;
  if (i == last) return;
  crowded_colors_[i] = crowded_colors_[last];
  crowded_slots_[i] = crowded_slots_[last];
  for (uint32_t copy = 0; copy < 4; ++copy)
    counts_[crowded_place(i) + copy * copy_stride_] = counts_[crowded_place(last) + copy * copy_stride_];
  slot_places_[crowded_slots_[i]] = crowded_place(i);
}

/// Another multiplier, and every member at its new place.
void LfcCollector::rehash() {
  std::array<uint32_t, kMaxEntries> counts{};
  for (uint32_t slot = 0; slot < entries_; ++slot)
    if (slot_places_[slot] != kNoSlot) counts[slot] = count_at(slot_places_[slot]);
  for (bool fits = false; !fits;) {
    table_.multiplier = ProbeTable::multiplier_of(++multiplier_index_);
    table_.reset(table_.size(), false);
    uint32_t collisions = 0;
    for (uint32_t slot = 0; slot < entries_; ++slot) {
      if (slot_places_[slot] == kNoSlot) continue;
      uint32_t& at = table_.colors[table_.bucket(slot_colors_[slot])];
      if (at != table_.filler(table_.bucket(slot_colors_[slot])))
        ++collisions;
      else
        at = slot_colors_[slot];
    }
    fits = collisions < kMaxCrowded;
  }
  table_.reset(table_.size(), false);
  crowded_ = 0;
  for (uint32_t slot = 0; slot < entries_; ++slot)
    if (slot_places_[slot] != kNoSlot) add_member(slot, slot_colors_[slot], counts[slot]);
}

void LfcCollector::fill_slot(uint32_t color, uint32_t count) {
  add_member(used_++, color, count);
  if (!full()) return;
  tail_slot_ = 0;
  for (uint32_t slot = 1; slot < entries_; ++slot)
    if (count_at(slot_places_[slot]) < count_at(slot_places_[tail_slot_])) tail_slot_ = slot;
  tail_color_ = slot_colors_[tail_slot_];
  tail_count_ = count_at(slot_places_[tail_slot_]);
  remove_member(tail_slot_);
  floor_ = tail_count_;
}

/// After hits on the tail: if another slot is now the smallest, it becomes the tail. True if it did.
bool LfcCollector::settle_tail() {
  if (tail_count_ < floor_) return false;
  uint32_t smallest_slot = kNoSlot, smallest = 0xFFFFFFFF, second = 0xFFFFFFFF;
  for (uint32_t slot = 0; slot < entries_; ++slot) {
    if (slot == tail_slot_) continue;
    const uint32_t count = count_at(slot_places_[slot]);
    if (count < smallest) {
      second = smallest;
      smallest = count;
      smallest_slot = slot;
    } else if (count < second) {
      second = count;
    }
  }
  floor_ = smallest;
  if (tail_count_ < smallest || (tail_count_ == smallest && tail_slot_ < smallest_slot)) return false;
  const uint32_t next_color = slot_colors_[smallest_slot];
  remove_member(smallest_slot);
  add_member(tail_slot_, tail_color_, tail_count_);
  floor_ = std::min(second, tail_count_);
  tail_slot_ = smallest_slot;
  tail_color_ = next_color;
  tail_count_ = smallest;
  return true;
}

void LfcCollector::see_run(uint32_t color, uint32_t count) {
  samples_ += count;
  const uint32_t place = place_of(color);
  if (place != outside()) {
    counts_[place] += count;
    return;
  }
  if (!full()) return fill_slot(color, count);
  tail_count_ = color == tail_color_ ? tail_count_ + count : count;
  tail_color_ = color;
  settle_tail();
}

/// The misses of a block at once: each takes the tail, and the last stays. False, and nothing happened, if so
/// many are alike in a row that another slot may become the tail.
bool LfcCollector::take_misses(const uint32_t* pixels, uint64_t misses) {
  std::array<uint32_t, kLanes + 16> colors;
  const uint64_t alike = kernels().compact(pixels, misses, tail_color_, colors.data());
  if (alike != 0 && tail_count_ + bit_count(alike) >= floor_) return false;
  const uint32_t count = bit_count(misses);
  const auto run = static_cast<uint32_t>(std::countl_one(alike << (kLanes - count)));
  tail_count_ = run == count ? tail_count_ + count : run + 1;
  tail_color_ = colors[count - 1];
  return true;
}

bool LfcCollector::see_block(const FewColors& few) {
  uint32_t places[FewColors::kMost];
  for (uint32_t n = 0; n < few.count; ++n) {
    places[n] = place_of(few.colors[n]);
    if (places[n] == outside()) return false;
  }
  for (uint32_t n = 0; n < few.count; ++n) counts_[places[n]] += bit_count(few.places[n]);
  samples_ += kLanes;
  return true;
}

void LfcCollector::see_block(const uint32_t* pixels) {
  uint32_t places[kLanes];
  uint32_t from = 0;  // pixels before are counted
  const auto count_hits = [&](uint32_t to) {
    for (; from < to; ++from) ++counts_[places[from] + (from & 3) * copy_stride_];
  };
  samples_ += kLanes;
  while (from < kLanes) {
    uint64_t misses =
        ~kernels().members(pixels, table_, crowded_colors_.data(), crowded_, places) & ~uint64_t{0} << from;
    bool changed = false;
    if (misses != 0 && full() && take_misses(pixels, misses)) {
      uint64_t hits = ~misses & ~uint64_t{0} << from;
      if (bit_count(hits) < kFewHits) {
        for (; hits != 0; hits &= hits - 1) {
          const auto lane = static_cast<uint32_t>(std::countr_zero(hits));
          ++counts_[places[lane] + (lane & 3) * copy_stride_];
        }
        return;
      }
      misses = 0;
    }
    for (; misses != 0 && !changed; misses &= misses - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(misses));
      const uint32_t color = pixels[lane];
      if (!full()) {
        count_hits(lane);
        fill_slot(color, 1);
        changed = true;
      } else if (color != tail_color_) {
        tail_color_ = color;
        tail_count_ = 1;
      } else if (++tail_count_ >= floor_) {
        count_hits(lane);
        changed = settle_tail();
      }
      if (changed) from = lane + 1;
    }
    if (!changed) count_hits(kLanes);
  }
}

void LfcCollector::store_to(Fvc& fvc) const {
  for (uint32_t slot = 0; slot < entries_; ++slot) {
    if (slot >= used_)
      fvc.set_slot(slot, 0, 0);
    else if (full() && slot == tail_slot_)
      fvc.set_slot(slot, tail_color_, tail_count_);
    else
      fvc.set_slot(slot, slot_colors_[slot], count_at(slot_places_[slot]));
  }
  fvc.set_samples(samples_);
}

}  // namespace tilepress
