// Slot table: insertion and removal.
#include "dcp/slot_table.h"

#include <bit>
#include <cstring>
#include <utility>

namespace tilepress {

void SlotTable::clear() {
  std::memset(buckets, kEmpty, sizeof buckets);
  stashed = 0;
}

/// Inserts the slot into one of its two buckets. A displaced slot moves to its other bucket, and so on. If
/// the chain does not end, the last slot goes to the stash.
void SlotTable::place(uint32_t slot) {
  constexpr uint32_t kMoves = 32;
  auto moving = static_cast<uint8_t>(slot);
  for (uint32_t which = 0; which < 2; ++which)
    if (uint8_t& bucket = bucket_of(colors[slot], which); bucket == kEmpty) {
      bucket = moving;
      return;
    }
  for (uint32_t move = 0, which = 0; move < kMoves; ++move, which ^= 1) {
    std::swap(moving, bucket_of(colors[moving], which));
    if (moving == kEmpty) return;
  }
  stashed |= uint64_t{1} << moving;
}

void SlotTable::insert(uint32_t slot, uint32_t color) {
  colors[slot] = color;
  for (uint32_t c = 0; c < 4; ++c) bytes[c][slot] = static_cast<uint8_t>(color >> 8 * c);
  place(slot);
}

void SlotTable::remove(uint32_t slot) {
  if ((stashed >> slot & 1) != 0) {
    stashed &= ~(uint64_t{1} << slot);
    return;
  }
  const uint32_t which = bucket_of(colors[slot], 0) == slot ? 0 : 1;
  bucket_of(colors[slot], which) = kEmpty;
  if (stashed == 0) return;
  const auto waiting = static_cast<uint32_t>(std::countr_zero(stashed));
  stashed &= stashed - 1;
  place(waiting);
}

uint32_t SlotTable::find(uint32_t color) const {
  for (uint32_t which = 0; which < 2; ++which) {
    const uint8_t slot = buckets[which][SlotBuckets::of(color, which)];
    if (slot != kEmpty && colors[slot] == color) return slot;
  }
  for (uint64_t left = stashed; left != 0; left &= left - 1) {
    const auto slot = static_cast<uint32_t>(std::countr_zero(left));
    if (colors[slot] == color) return slot;
  }
  return kAbsent;
}

}  // namespace tilepress
