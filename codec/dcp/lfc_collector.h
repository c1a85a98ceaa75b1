// LFC collector: the fully associative FVC with least-frequent replacement, at the speed of a look-up.
//
// The same result as Fvc, slot for slot, from three observations:
//  - The victim of a miss is the slot of the smallest (count, slot). A miss puts count 1 there, which is at
//  most
//    every other count, so that slot stays the victim until its colour is hit. Call it the tail; all other
//    slots only ever grow.
//  - Between two changes of the tail, the order of hits on the other slots does not matter: they can be
//  counted in
//    any order, and membership can be tested for a whole block at once.
//  - A run of misses collapses to its last colour.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dcp/probe_kernels.h"
#include "dcp/slot_kernels.h"

namespace tilepress {

class Fvc;

/// Is told of every pixel of a frame by its end, each once, in any order.
class ColorListener {
 public:
  virtual ~ColorListener() = default;
  /// `count` pixels of one colour.
  virtual void see_run(uint32_t color, uint32_t count) = 0;
  /// `count` pixels, at most 64. Bit i of `alike`: pixel i is of the colour of the one before it; of no
  /// meaning for i = 0.
  virtual void see_pixels(const uint32_t* pixels, uint32_t count, uint64_t alike) = 0;
};

class LfcCollector {
 public:
  static constexpr uint32_t kMaxEntries = 128;  ///< beyond, collisions in the table would become common

  /// entries: a power of two, 2..kMaxEntries.
  explicit LfcCollector(uint32_t entries);
  void reset();
  /// Whom to tell, until the next reset(). What the FVC holds is told at once when it leaves, or by
  /// tell_held(): a collector that counts colours anyway saves the listener most of the work.
  void listen(ColorListener* listener) { listener_ = listener; }
  /// After the last pixel of a frame.
  void tell_held();
  /// A whole block, 64 pixels in traversal order.
  void see_block(const uint32_t* pixels);
  /// The same, where SlotKernels::find() found its `slots` among members(); they are of no meaning then.
  void see_found(const uint32_t* pixels, FoundSlots found, uint8_t* slots);
  /// The same for a block of few colours. False, and nothing happened, if not all of them are held.
  bool see_block(const FewColors& few);
  /// `count` pixels of one colour in a row.
  void see_run(uint32_t color, uint32_t count);
  /// What to look for in the next block; null if it is not kept so.
  const SlotTable* members() const { return by_slots_ ? &slots_ : nullptr; }
  /// Hands slots, counts and samples to the plain FVC.
  void store_to(Fvc& fvc) const;

 private:
  static constexpr uint32_t kMaxCrowded = 8;
  static constexpr uint32_t kNoSlot = 0xFFFFFFFF, kNoCount = 0xFFFFFFFF;

  uint32_t outside() const { return by_slots_ ? SlotTable::kAbsent : table_.size(); }
  uint32_t crowded_place(uint32_t i) const { return table_.size() + 1 + i; }
  bool full() const { return used_ == entries_; }
  uint32_t place_of(uint32_t color) const;
  uint32_t count_at(uint32_t place) const;
  void add_member(uint32_t slot, uint32_t color, uint32_t count);
  void remove_member(uint32_t slot);
  void rehash();
  void fill_slot(uint32_t color, uint32_t count);
  bool settle_tail();
  Smallest find_smallest() const;
  void forget_counts(uint32_t slot);
  bool take_few_misses(const uint32_t* pixels, uint64_t misses);
  uint32_t first_to_settle(uint64_t alike) const;
  void tell(uint32_t color, uint32_t count) {
    if (listener_ != nullptr && count != 0) listener_->see_run(color, count);
  }
  template <class Place>
  void count_hits(const Place* places, uint32_t from, uint32_t to);
  template <class Place>
  void count_rest(const Place* places, FoundSlots found, uint32_t from);
  template <class CountTo>
  bool take_misses(const uint32_t* pixels, uint64_t misses, uint64_t begins, const CountTo& count_to);
  template <class Place, class Find>
  void take_block(const uint32_t* pixels, Place* places, FoundSlots found, const Find& find);

  const uint32_t entries_;
  const bool by_slots_;  ///< slots_ holds the members, and a member's place is its slot; else table_ does
  uint32_t used_ = 0;    ///< slots filled
  uint64_t samples_ = 0;
  uint32_t tail_slot_ = 0, tail_color_ = 0, tail_count_ = 0;  ///< valid once full
  uint32_t floor_ = 0;                                        ///< no other slot has a smaller count
  SlotTable slots_;                                           ///< colours of all slots but the tail
  ProbeTable table_;                                          ///< the same but the crowded ones
  uint32_t crowded_ = 0;                                      ///< colours whose bucket was taken
  std::array<uint32_t, kMaxCrowded> crowded_colors_{}, crowded_slots_{};
  uint32_t multiplier_index_ = 0;
  /// Counts by place (bucket, outside, crowded), in four copies that are summed when needed: adding to one
  /// address again and again would wait for the store before.
  std::vector<uint32_t> counts_;
  uint32_t copy_stride_;
  std::vector<uint32_t> slot_places_, slot_colors_;
  ColorListener* listener_ = nullptr;
  std::vector<uint32_t> slot_told_;  ///< pixels of the slot's count that the listener knows of
};

}  // namespace tilepress
