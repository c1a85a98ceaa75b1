// FVC slots: what a run collector holds, and the order in which its policy evicts.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "cpu/bit_count.h"
#include "dcp/color_map.h"
#include "dcp/fast_fvc.h"

namespace tilepress {

/// The slots of an FVC in sets of `ways`. Slots fill in order and never empty again.
struct FvcSlots {
  FvcSlots(uint32_t entries, uint32_t ways_per_set)
      : ways(ways_per_set), used(entries / ways_per_set), colors(entries), counts(entries) {}
  void clear() {
    std::fill(used.begin(), used.end(), 0u);
    std::fill(counts.begin(), counts.end(), 0u);
    listener = nullptr;
  }
  /// Evicts what the slot holds.
  void put(uint32_t slot, uint32_t color, uint32_t count) {
    tell(slot);
    colors[slot] = color;
    counts[slot] = count;
  }
  /// A colour's count has all its pixels since it came.
  void tell(uint32_t slot) const {
    if (listener != nullptr && counts[slot] != 0) listener->see_run(colors[slot], counts[slot]);
  }
  const uint32_t ways;
  ColorListener* listener = nullptr;
  std::vector<uint32_t> used;            ///< slots filled, by set
  std::vector<uint32_t> colors, counts;  ///< by slot; count 0: empty
};

// An order evicts for one policy. It sees each event of the slots:
//   reset()                 all slots are empty
//   fill(slot)              the slot got its first colour; the set may be full now
//   hit(slot)               a colour of the map came again
//   miss(set, color, count) `count` pixels of a colour that the map lacks came to a full set

/// Evicts the slot that was hit or filled least recently, by one list per set.
class LeastRecentOrder {
 public:
  LeastRecentOrder(FvcSlots& slots, ColorMap& map)
      : slots_(slots), map_(map), before_(slots.colors.size() + slots.used.size()), after_(before_.size()) {}
  void reset() {
    for (uint32_t set = 0; set < slots_.used.size(); ++set)
      before_[head(set)] = after_[head(set)] = static_cast<uint16_t>(head(set));
  }
  void fill(uint32_t slot) { push(slot, head(slot / slots_.ways)); }
  void hit(uint32_t slot) {
    const uint32_t top = head(slot / slots_.ways);
    if (after_[top] == slot) return;
    after_[before_[slot]] = after_[slot];
    before_[after_[slot]] = before_[slot];
    push(slot, top);
  }
  void miss(uint32_t set, uint32_t color, uint32_t count) {
    const uint32_t slot = before_[head(set)];
    map_.remove(slots_.colors[slot]);
    map_.insert(color, slot);
    slots_.put(slot, color, count);
    hit(slot);
  }

 private:
  uint32_t head(uint32_t set) const { return static_cast<uint32_t>(slots_.colors.size()) + set; }
  void push(uint32_t slot, uint32_t top) {
    before_[slot] = static_cast<uint16_t>(top);
    after_[slot] = after_[top];
    before_[after_[slot]] = static_cast<uint16_t>(slot);
    after_[top] = static_cast<uint16_t>(slot);
  }
  FvcSlots& slots_;
  ColorMap& map_;
  std::vector<uint16_t> before_, after_;  ///< by slot, then the head of each set; the most recent comes first
};

/// The generator of the random policy.
class Xorshift32 {
 public:
  void reset() { state_ = 0x9E3779B9u; }
  uint32_t next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    return state_ ^= state_ << 5;
  }

 private:
  uint32_t state_ = 0;
};

/// Evicts a slot at random.
class RandomOrder {
 public:
  RandomOrder(FvcSlots& slots, ColorMap& map) : slots_(slots), map_(map) {}
  void reset() { random_.reset(); }
  void fill(uint32_t) {}
  void hit(uint32_t) {}
  void miss(uint32_t set, uint32_t color, uint32_t count) {
    const uint32_t slot = set * slots_.ways + random_.next() % slots_.ways;
    map_.remove(slots_.colors[slot]);
    map_.insert(color, slot);
    slots_.put(slot, color, count);
  }

 private:
  FvcSlots& slots_;
  ColorMap& map_;
  Xorshift32 random_;
};

/// Evicts the slot of the smallest (count, slot), or of the second smallest.
///
/// The `kTails` smallest slots of a full set are its tails, in ascending order; a miss evicts the last one.
/// Its count is 1 then, at most every other count, so that misses stay among the tails, which are not in the
/// map: a miss costs one search that fails. All other slots only grow. One of them changes places with the
/// last tail when that has become the larger. So each search for the smallest of them goes on where the one
/// before ended, until no slot has that count.
template <uint32_t kTails>
class LeastFrequentOrder {
 public:
  LeastFrequentOrder(FvcSlots& slots, ColorMap& map) : slots_(slots), map_(map), sets_(slots.used.size()) {}
  void reset() { std::fill(sets_.begin(), sets_.end(), Set{}); }
  void fill(uint32_t slot) {
    const uint32_t number = slot / slots_.ways, first = number * slots_.ways;
    if (slots_.used[number] < slots_.ways) return;
    Set& set = sets_[number];
    set.tails.fill(kNone);
    for (uint32_t& tail : set.tails) {
      uint32_t smallest = first;
      for (uint32_t at = first; at < first + slots_.ways; ++at)
        if (!is_tail(set, at) && (is_tail(set, smallest) || less(at, smallest))) smallest = at;
      tail = smallest;
      map_.remove(slots_.colors[smallest]);
    }
    set.next = first;
  }
  void hit(uint32_t) {}
  void miss(uint32_t number, uint32_t color, uint32_t count) {
    if (touch(number, color, count)) settle(number);
  }
  /// The first half of miss(). Returns true if settle() must follow, which reads the counts of all slots.
  bool touch(uint32_t number, uint32_t color, uint32_t count) {
    auto& tails = sets_[number].tails;
    uint32_t at = kTails - 1;
    if (kTails > 1 && slots_.colors[tails[0]] == color) at = 0;
    if (slots_.colors[tails[at]] == color)
      slots_.counts[tails[at]] += count;
    else
      slots_.put(tails[at], color, count);
    for (uint32_t i = kTails - 1; i > 0; --i)
      if (less(tails[i], tails[i - 1])) std::swap(tails[i], tails[i - 1]);
    return slots_.counts[tails[kTails - 1]] >= sets_[number].floor;
  }
  /// Takes the misses of a block at once if none of them can make another slot a tail, and all take the last
  /// one. Returns false, and takes none, if not. `places(color)` returns the pixels of a colour.
  template <class Places>
  bool touch_all(uint32_t number, const uint32_t* pixels, uint64_t misses, const Places& places) {
    const Set& set = sets_[number];
    const uint32_t last = set.tails[kTails - 1], first = set.tails[0], all = bit_count(misses);
    if (slots_.counts[last] + all >= set.floor) return false;
    if (kTails > 1 &&
        (slots_.counts[first] != 1 || first > last || (places(slots_.colors[first]) & misses) != 0))
      return false;
    const uint32_t color = pixels[std::bit_width(misses) - 1];
    const uint64_t others = misses & ~places(color);
    if (others == 0 && color == slots_.colors[last]) {
      slots_.counts[last] += all;
      return true;
    }
    // All but the last run only pass.
    const uint64_t passing = others == 0 ? 0 : misses & ((uint64_t{2} << (std::bit_width(others) - 1)) - 1);
    slots_.put(last, color, all - bit_count(passing));
    if (slots_.listener != nullptr)
      for (uint64_t left = passing; left != 0; left &= left - 1)
        slots_.listener->see_run(pixels[std::countr_zero(left)], 1);
    return true;
  }
  /// The second half. Returns true if the colours of the map changed.
  bool settle(uint32_t number) {
    Set& set = sets_[number];
    uint32_t& last = set.tails[kTails - 1];
    const uint32_t smallest = find_smallest(set, number);
    if (less(last, smallest)) return false;
    map_.remove(slots_.colors[smallest]);
    map_.insert(slots_.colors[last], last);
    last = smallest;
    return true;
  }

 private:
  static constexpr uint32_t kNone = 0xFFFFFFFF;
  struct Set {
    std::array<uint32_t, kTails> tails{};
    uint32_t floor = 0;  ///< no other slot has a smaller count
    uint32_t next = 0;   ///< no slot before this one has that count, but for tails
  };
  bool less(uint32_t a, uint32_t b) const {
    return slots_.counts[a] != slots_.counts[b] ? slots_.counts[a] < slots_.counts[b] : a < b;
  }
  bool is_tail(const Set& set, uint32_t slot) const {
    return std::find(set.tails.begin(), set.tails.end(), slot) != set.tails.end();
  }
  /// Returns the smallest slot of those that are no tails.
  uint32_t find_smallest(Set& set, uint32_t number) const {
    const uint32_t first = number * slots_.ways, end = first + slots_.ways;
    const auto search = [&] {
      while (set.next < end && (slots_.counts[set.next] != set.floor || is_tail(set, set.next))) ++set.next;
      return set.next < end;
    };
    if (search()) return set.next;
    set.floor = kNone;
    for (uint32_t at = first; at < end; ++at)
      if (!is_tail(set, at)) set.floor = std::min(set.floor, slots_.counts[at]);
    set.next = first;
    search();
    return set.next;
  }
  FvcSlots& slots_;
  ColorMap& map_;
  std::vector<Set> sets_;
};

}  // namespace tilepress
