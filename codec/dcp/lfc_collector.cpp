// LFC collector: see the header for why this equals the plain FVC.
#include "dcp/lfc_collector.h"

#include <algorithm>
#include <bit>

#include "cpu/bit_count.h"
#include "dcp/fvc.h"
#include "pixels/pixel_kernels.h"

namespace tilepress {
namespace {
constexpr uint32_t kFewHits = 24;  ///< so few are counted one by one; of more, all lanes without a branch
constexpr uint32_t kFewRuns = 24;  ///< where there are so few, slots are counted one by one
}  // namespace

template <class Members>
LfcCollector<Members>::LfcCollector(uint32_t entries)
    : entries_(entries), members_(entries), slot_told_(entries) {
  reset();
}

template <class Members>
void LfcCollector<Members>::reset() {
  members_.clear();
  used_ = floor_ = 0;
  samples_ = 0;
  listener_ = nullptr;
}

template <class Members>
void LfcCollector<Members>::remove_member(uint32_t slot) {
  tell(members_.color(slot), members_.count(slot) - slot_told_[slot]);
  members_.remove(slot);
}

template <class Members>
void LfcCollector<Members>::fill_slot(uint32_t color, uint32_t count) {
  tell(color, count);
  slot_told_[used_] = count;
  members_.insert(used_++, color, count);
  if (!full()) return;
  const Smallest found = members_.find_smallest();
  tail_slot_ = found.at;
  tail_color_ = members_.color(tail_slot_);
  tail_count_ = floor_ = found.smallest;
  remove_member(tail_slot_);
}

/// After hits on the tail: if another slot is now the smallest, it becomes the tail. True if it did.
template <class Members>
bool LfcCollector<Members>::settle_tail() {
  if (tail_count_ < floor_) return false;
  const Smallest found = members_.find_smallest();
  floor_ = found.smallest;
  if (tail_count_ < found.smallest || (tail_count_ == found.smallest && tail_slot_ < found.at)) return false;
  const uint32_t next_color = members_.color(found.at);
  remove_member(found.at);
  slot_told_[tail_slot_] = tail_count_;
  members_.insert(tail_slot_, tail_color_, tail_count_);
  floor_ = std::min(found.second, tail_count_);
  tail_slot_ = found.at;
  tail_color_ = next_color;
  tail_count_ = found.smallest;
  return true;
}

template <class Members>
void LfcCollector<Members>::see_run(uint32_t color, uint32_t count) {
  samples_ += count;
  const uint32_t place = members_.place_of(color);
  if (place != members_.outside()) {
    members_.counts().copy(0)[place] += count;
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
template <class Members>
bool LfcCollector<Members>::take_few_misses(const uint32_t* pixels, uint64_t misses) {
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
template <class Members>
uint32_t LfcCollector<Members>::first_to_settle(uint64_t alike) const {
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

/// Takes a block of few colours. Returns false, and takes nothing, if one is no member.
template <class Members>
bool LfcCollector<Members>::take_few(const FewColors& few) {
  uint32_t places[FewColors::kMost];
  for (uint32_t n = 0; n < few.count; ++n) {
    places[n] = members_.place_of(few.colors[n]);
    if (places[n] == members_.outside()) return false;
  }
  for (uint32_t n = 0; n < few.count; ++n) members_.counts().copy(0)[places[n]] += bit_count(few.places[n]);
  samples_ += kBlockPixels;
  return true;
}

/// Counts pixels `from` to `to` at their places.
template <class Members>
void LfcCollector<Members>::count_hits(uint32_t from, uint32_t to) {
  const auto* places = members_.places();
  PlaceCounts& counts = members_.counts();
  uint32_t* const copies[4] = {counts.copy(0), counts.copy(1), counts.copy(2), counts.copy(3)};
  for (; from < to && from % 4 != 0; ++from) ++copies[from % 4][places[from]];
  for (; from + 4 <= to; from += 4)
    for (uint32_t i = 0; i < 4; ++i) ++copies[i][places[from + i]];
  for (; from < to; ++from) ++copies[from % 4][places[from]];
}

/// Counts pixels `from` to the last of a block, in the quickest way.
template <class Members>
void LfcCollector<Members>::count_rest(FoundSlots found, uint32_t from) {
  if (from == kBlockPixels) return;
  const uint64_t rest = ~uint64_t{0} << from;
  uint64_t hits = found.known & rest;
  if (hits == 0) return;
  const bool few_runs = bit_count(found.begins & rest) <= kFewRuns;
  if (!few_runs && bit_count(hits) > kFewHits) return count_hits(from, kBlockPixels);
  if (few_runs) hits = members_.count_few(hits);
  for (; hits != 0; hits &= hits - 1) {
    const auto lane = static_cast<uint32_t>(std::countr_zero(hits));
    ++members_.counts().copy(lane & 3)[members_.places()[lane]];
  }
}

/// Takes misses up to the first that changes the members, if one does; true then. `begins` are those of a
/// block of misses. `count_to(lane)` counts the hits before `lane`, which must be done before members change.
template <class Members>
template <class CountTo>
bool LfcCollector<Members>::take_misses(const uint32_t* pixels, uint64_t misses, uint64_t begins,
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

/// `found` is what members_.find() returned last.
template <class Members>
void LfcCollector<Members>::take_block(const uint32_t* pixels, FoundSlots found) {
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
    return count_rest(found, 0);
  for (uint32_t from = 0; from < kBlockPixels; found = members_.find(pixels)) {  // pixels before are counted
    const auto count_to = [&](uint32_t lane) {
      count_hits(from, lane);
      from = lane;
    };
    const uint64_t misses = ~found.known & ~uint64_t{0} << from;
    if (misses == 0 || !take_misses(pixels, misses, found.begins, count_to)) return count_rest(found, from);
  }
}

template <class Members>
void LfcCollector<Members>::see(const SeenPixels& seen) {
  if (seen.count == kBlockPixels) {
    const MemberLookup* done = seen.found ? members_.lookup() : nullptr;
    if (done == nullptr && seen.few != nullptr && take_few(*seen.few)) return;
    return take_block(seen.pixels, done != nullptr ? done->found : members_.find(seen.pixels));
  }
  for (uint32_t i = 0; i < seen.count; ++i) see_run(seen.pixels[i], 1);
}

template <class Members>
void LfcCollector<Members>::tell_held() {
  if (listener_ == nullptr) return;
  for (uint32_t slot = 0; slot < used_; ++slot) {
    if (!is_member(slot)) continue;
    const uint32_t count = members_.count(slot);
    tell(members_.color(slot), count - slot_told_[slot]);
    slot_told_[slot] = count;
  }
}

template <class Members>
void LfcCollector<Members>::store_to(Fvc& fvc) {
  tell_held();
  for (uint32_t slot = 0; slot < entries_; ++slot)
    if (is_member(slot))
      fvc.set_slot(slot, members_.color(slot), members_.count(slot));
    else
      fvc.set_slot(slot, tail_color_, full() ? tail_count_ : 0);
  fvc.set_samples(samples_);
}

template class LfcCollector<SlotMembers>;
template class LfcCollector<ProbeMembers>;

}  // namespace tilepress
