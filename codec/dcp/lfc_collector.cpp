// LFC collector: see the header for why this equals the plain FVC.
#include "dcp/lfc_collector.h"

#include <algorithm>
#include <bit>

#include "cpu/bit_count.h"
#include "dcp/fvc.h"
#include "pixels/pixel_kernels.h"

namespace tilepress {
namespace {
constexpr uint32_t kBucketsPerEntry = 16;
constexpr uint32_t kFewHits = 24;  ///< so few are counted one by one; of more, all lanes without a branch
constexpr uint32_t kFewRuns = 24;  ///< where there are so few, slots are counted one by one
}  // namespace

LfcCollector::LfcCollector(uint32_t entries)
    : entries_(entries),
      by_slots_(slot_kernels().byte_permutes && entries <= SlotTable::kSlots),
      slot_places_(entries, kNoSlot),
      slot_colors_(entries),
      slot_told_(entries) {
  table_.multiplier = ProbeTable::multiplier_of(0);
  table_.reset(by_slots_ ? 2 : entries * kBucketsPerEntry, false);
  copy_stride_ = by_slots_ ? SlotTable::kAbsent + 1 : table_.size() + 1 + kMaxCrowded;
  counts_.resize(size_t{copy_stride_} * 4);
  reset();
}

void LfcCollector::reset() {
  by_slots_ ? slots_.clear() : table_.reset(table_.size(), false);
  std::fill(counts_.begin(), counts_.end(), 0u);
  if (by_slots_) std::fill_n(counts_.begin(), SlotTable::kSlots, kNoCount);
  std::fill(slot_places_.begin(), slot_places_.end(), kNoSlot);
  used_ = crowded_ = 0;
  samples_ = 0;
  listener_ = nullptr;
  floor_ = 0;
}

uint32_t LfcCollector::place_of(uint32_t color) const {
  if (by_slots_) return slots_.find(color);
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
  uint32_t place = slot;
  if (by_slots_) {
    slots_.insert(slot, color);
  } else if (const uint32_t bucket = table_.bucket(color); table_.colors[bucket] == table_.filler(bucket)) {
    table_.colors[bucket] = color;
    place = bucket;
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

/// A slot without a member is never the smallest.
void LfcCollector::forget_counts(uint32_t slot) {
  counts_[slot] = kNoCount;
  for (uint32_t copy = 1; copy < 4; ++copy) counts_[slot + copy * copy_stride_] = 0;
}

void LfcCollector::remove_member(uint32_t slot) {
  const uint32_t place = slot_places_[slot];
  tell(slot_colors_[slot], count_at(place) - slot_told_[slot]);
  slot_places_[slot] = kNoSlot;
  if (by_slots_) {
    forget_counts(slot);
    return slots_.remove(slot);
  }
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
  tell(color, count);
  slot_told_[used_] = count;
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

/// The smallest counts of the slots but the tail.
Smallest LfcCollector::find_smallest() const {
  if (by_slots_) return probe_kernels().find_smallest(counts_.data(), copy_stride_);
  Smallest found = {kNoSlot, kNoCount, kNoCount};
  for (uint32_t slot = 0; slot < entries_; ++slot) {
    if (slot == tail_slot_) continue;
    const uint32_t count = count_at(slot_places_[slot]);
    if (count < found.smallest)
      found = {slot, count, found.smallest};
    else
      found.second = std::min(found.second, count);
  }
  return found;
}

/// After hits on the tail: if another slot is now the smallest, it becomes the tail. True if it did.
bool LfcCollector::settle_tail() {
  if (tail_count_ < floor_) return false;
  const Smallest found = find_smallest();
  floor_ = found.smallest;
  if (tail_count_ < found.smallest || (tail_count_ == found.smallest && tail_slot_ < found.at)) return false;
  const uint32_t next_color = slot_colors_[found.at];
  remove_member(found.at);
  slot_told_[tail_slot_] = tail_count_;
  add_member(tail_slot_, tail_color_, tail_count_);
  floor_ = std::min(found.second, tail_count_);
  tail_slot_ = found.at;
  tail_color_ = next_color;
  tail_count_ = found.smallest;
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
  tell(color, count);
  tail_count_ = color == tail_color_ ? tail_count_ + count : count;
  tail_color_ = color;
  settle_tail();
}

/// The misses of a block at once, if they are too few to make another slot the tail, however they are. False,
/// and nothing happened, if not.
bool LfcCollector::take_few_misses(const uint32_t* pixels, uint64_t misses) {
  const uint32_t count = bit_count(misses);
  if (tail_count_ + count >= floor_) return false;
  const uint32_t color = pixels[kBlockPixels - 1 - static_cast<uint32_t>(std::countl_zero(misses))];
  const uint64_t others = misses & ~pixel_kernels().places_of(pixels, color);
  // The last of another colour; those behind it are a run.
  const uint32_t run = others == 0 ? count : bit_count(misses & ~(~uint64_t{0} >> std::countl_zero(others)));
  tail_count_ = others == 0 && color == tail_color_ ? tail_count_ + count : run;
  tail_color_ = color;
  return true;
}

/// Of a number of misses, bit i of `alike` set where number i is of the colour of the one before it, or
/// number 0 of that of the tail: the number of the first at which the tail is hit and has as many as the
/// floor; kBlockPixels if there is none.
uint32_t LfcCollector::first_to_settle(uint64_t alike) const {
  const auto on_tail = static_cast<uint32_t>(std::countr_one(alike));
  if (on_tail != 0 && tail_count_ + on_tail >= floor_)
    return floor_ > tail_count_ ? floor_ - tail_count_ - 1 : 0;
  // A colour takes the tail with a count of 1, and each that is alike adds 1.
  const uint32_t wanted = std::max(floor_, 2u) - 1;
  if (wanted >= kBlockPixels) return kBlockPixels;
  uint64_t ends = alike & (alike + 1);  // without those on the tail
  for (uint32_t have = 1; have < wanted && ends != 0;) {
    const uint32_t more = std::min(have, wanted - have);
    ends &= ends << more;
    have += more;
  }
  return static_cast<uint32_t>(std::countr_zero(ends));
}

bool LfcCollector::see_block(const FewColors& few) {
  uint32_t places[FewColors::kMost];
  for (uint32_t n = 0; n < few.count; ++n) {
    places[n] = place_of(few.colors[n]);
    if (places[n] == outside()) return false;
  }
  for (uint32_t n = 0; n < few.count; ++n) counts_[places[n]] += bit_count(few.places[n]);
  samples_ += kBlockPixels;
  return true;
}

/// Counts pixels `from` to `to` at their places.
template <class Place>
void LfcCollector::count_hits(const Place* places, uint32_t from, uint32_t to) {
  uint32_t* const copies[4] = {&counts_[0], &counts_[copy_stride_], &counts_[2 * copy_stride_],
                               &counts_[3 * copy_stride_]};
  for (; from < to && from % 4 != 0; ++from) ++copies[from % 4][places[from]];
  for (; from + 4 <= to; from += 4)
    for (uint32_t i = 0; i < 4; ++i) ++copies[i][places[from + i]];
  for (; from < to; ++from) ++copies[from % 4][places[from]];
}

/// Counts pixels `from` to the last of a block, in the quickest way.
template <class Place>
void LfcCollector::count_rest(const Place* places, FoundSlots found, uint32_t from) {
  if (from == kBlockPixels) return;
  const uint64_t rest = ~uint64_t{0} << from;
  uint64_t hits = found.known & rest;
  if (hits == 0) return;
  const bool few_runs = bit_count(found.begins & rest) <= kFewRuns;
  if (!few_runs && bit_count(hits) > kFewHits) return count_hits(places, from, kBlockPixels);
  if constexpr (sizeof(Place) == 1)
    if (few_runs) hits = slot_kernels().count(places, hits, counts_.data());
  for (; hits != 0; hits &= hits - 1) {
    const auto lane = static_cast<uint32_t>(std::countr_zero(hits));
    ++counts_[places[lane] + (lane & 3) * copy_stride_];
  }
}

/// Takes misses up to the first that changes the members, if one does; true then. `begins` are those of a
/// block of misses. `count_to(lane)` counts the hits before `lane`, which must be done before members change.
template <class CountTo>
bool LfcCollector::take_misses(const uint32_t* pixels, uint64_t misses, uint64_t begins,
                               const CountTo& count_to) {
  if (!full()) {
    const auto lane = static_cast<uint32_t>(std::countr_zero(misses));
    count_to(lane + 1);
    fill_slot(pixels[lane], 1);
    return true;
  }
  std::array<uint32_t, kBlockPixels + 16> packed;
  const bool all = misses == ~uint64_t{0};  // then there is nothing to pack
  const uint32_t* colors = all ? pixels : packed.data();
  uint64_t alike = all ? ~begins | (pixels[0] == tail_color_ ? 1 : 0)
                       : probe_kernels().compact(pixels, misses, tail_color_, packed.data());
  while (misses != 0) {
    const uint32_t settles = first_to_settle(alike), left = bit_count(misses);
    const uint32_t count = std::min(settles + 1, left);
    if (listener_ != nullptr) listener_->see_pixels(colors, count, alike);
    const auto run = static_cast<uint32_t>(std::countl_one(alike << (kBlockPixels - count)));
    tail_count_ = run == count ? tail_count_ + count : run + 1;
    tail_color_ = colors[count - 1];
    if (settles == kBlockPixels) return false;
    for (uint32_t i = 0; i < settles; ++i) misses &= misses - 1;
    const auto lane = static_cast<uint32_t>(std::countr_zero(misses));
    misses &= misses - 1;
    colors += count;
    alike = alike >> settles >> 1;
    count_to(lane + 1);
    if (settle_tail()) return true;
  }
  return false;
}

/// `places` and `found` are those of the block's pixels; find() finds them anew.
template <class Place, class Find>
void LfcCollector::take_block(const uint32_t* pixels, Place* places, FoundSlots found, const Find& find) {
  samples_ += kBlockPixels;
  if (found.known == 0 && found.begins == ~uint64_t{0} && full() && pixels[0] != tail_color_) {
    // Each takes the tail from the one before it.
    if (listener_ != nullptr) listener_->see_pixels(pixels, kBlockPixels, 0);
    tail_color_ = pixels[kBlockPixels - 1];
    tail_count_ = 1;
    return;
  }
  if (found.known == ~uint64_t{0} ||
      (full() && listener_ == nullptr && take_few_misses(pixels, ~found.known)))
    return count_rest(places, found, 0);
  for (uint32_t from = 0; from < kBlockPixels; found = find()) {  // pixels before are counted
    const auto count_to = [&](uint32_t lane) {
      count_hits(places, from, lane);
      from = lane;
    };
    const uint64_t misses = ~found.known & ~uint64_t{0} << from;
    if (misses == 0 || !take_misses(pixels, misses, found.begins, count_to))
      return count_rest(places, found, from);
  }
}

void LfcCollector::see_found(const uint32_t* pixels, FoundSlots found, uint8_t* slots) {
  take_block(pixels, slots, found, [&] { return slot_kernels().find(pixels, slots_, slots); });
}

void LfcCollector::see_block(const uint32_t* pixels) {
  if (by_slots_) {
    uint8_t slots[kBlockPixels];
    return see_found(pixels, slot_kernels().find(pixels, slots_, slots), slots);
  }
  uint32_t places[kBlockPixels];
  const auto find = [&]() -> FoundSlots {
    const uint64_t known = probe_kernels().members(pixels, table_, crowded_colors_.data(), crowded_, places);
    return {known, known == 0 ? pixel_kernels().run_begins(pixels) : ~uint64_t{0}};
  };
  take_block(pixels, places, find(), find);
}

void LfcCollector::tell_held() {
  if (listener_ == nullptr) return;
  for (uint32_t slot = 0; slot < used_; ++slot) {
    if (slot_places_[slot] == kNoSlot) continue;
    const uint32_t count = count_at(slot_places_[slot]);
    tell(slot_colors_[slot], count - slot_told_[slot]);
    slot_told_[slot] = count;
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
