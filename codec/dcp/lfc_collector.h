// LFC collector: the fully associative FVC with least-frequent replacement, a block at a time.
//
// The same result as Fvc, slot for slot, from three observations:
//  - The victim of a miss is the slot of the smallest (count, slot). A miss puts count 1 there, at most every
//    other count, so that the slot stays the victim until its colour is hit. Call it the tail. All other
//    slots only ever grow.
//  - Between two changes of the tail, the order of hits on the other slots does not matter: they can be
//  counted
//    in any order, and a whole block can be looked up at once.
//  - A run of misses collapses to its last colour.
#pragma once

#include <cstdint>
#include <vector>

#include "dcp/fast_fvc.h"
#include "dcp/lfc_members.h"

namespace tilepress {

/// `Members` is a class of lfc_members.h.
template <class Members>
class LfcCollector final : public FastFvc {
 public:
  /// entries: a power of two from 2 to the most that Members holds.
  explicit LfcCollector(uint32_t entries);
  void reset() override;
  /// What the FVC holds is reported when it leaves, or by store_to(): that saves the listener most of the
  /// work.
  void listen(ColorListener* listener) override { listener_ = listener; }
  void see_run(uint32_t color, uint32_t count) override;
  void see(const SeenPixels& seen) override;
  MemberLookup* lookup() override { return members_.lookup(); }
  void store_to(Fvc& fvc) override;

 private:
  bool full() const { return used_ == entries_; }
  bool is_member(uint32_t slot) const { return slot < used_ && !(full() && slot == tail_slot_); }
  void remove_member(uint32_t slot);
  void fill_slot(uint32_t color, uint32_t count);
  bool settle_tail();
  void tell(uint32_t color, uint32_t count) {
    if (listener_ != nullptr && count != 0) listener_->see_run(color, count);
  }
  void tell_held();

  void count_hits(uint32_t from, uint32_t to);
  bool take_few(const FewColors& few);
  void count_rest(FoundSlots found, uint32_t from);
  bool take_few_misses(const uint32_t* pixels, uint64_t misses);
  uint32_t first_to_settle(uint64_t alike) const;
  template <class CountTo>
  bool take_misses(const uint32_t* pixels, uint64_t misses, uint64_t begins, const CountTo& count_to);
  void take_block(const uint32_t* pixels, FoundSlots found);

  const uint32_t entries_;
  uint32_t used_ = 0;  ///< slots filled
  uint64_t samples_ = 0;
  uint32_t tail_slot_ = 0, tail_color_ = 0, tail_count_ = 0;  ///< valid once full
  uint32_t floor_ = 0;                                        ///< no other slot has a smaller count
  Members members_;                                           ///< all slots but the tail
  ColorListener* listener_ = nullptr;
  std::vector<uint32_t> slot_told_;  ///< pixels of the slot's count that the listener knows of
};

extern template class LfcCollector<SlotMembers>;
extern template class LfcCollector<ProbeMembers>;

}  // namespace tilepress
