// Slot kernels: 64 pixels looked up in a slot table at once.
#pragma once

#include <vector>

#include "cpu/cpu_target.h"
#include "dcp/slot_table.h"

namespace tilepress {

struct FoundSlots {
  uint64_t known;  ///< bit i: pixel i has a slot
  /// Bit i: pixel i has another slot than the pixel before it, or another colour if no pixel has a slot. Bit
  /// 0 is set.
  uint64_t begins;
};

/// The parameters of `index`, and where its answers go.
struct IndexLookup {
  const SlotTable* table;
  uint16_t* indices;
  uint8_t* widths;
};

/// The parameters of `find`, and its answers.
struct MemberLookup {
  const SlotTable* table;
  FoundSlots found;
  uint8_t slots[kBlockPixels];
};

/// What `load` looks a block up in.
struct SlotLookups {
  std::vector<IndexLookup> dictionaries;
  std::vector<MemberLookup*> members;
  bool empty() const { return dictionaries.empty() && members.empty(); }
};

struct SlotKernels {
  /// True if these kernels are faster than probe kernels.
  bool byte_permutes;

  /// See PixelKernels::load_traversal. Looks the pixels up unless they are all equal.
  bool (*load)(const uint32_t* top_left, uint32_t stride, uint32_t* pixels, const SlotLookups& lookups);

  /// slots[i] = the slot of pixels[i], or SlotTable::kAbsent.
  FoundSlots (*find)(const uint32_t* pixels, const SlotTable& table, uint8_t* slots);

  /// Adds the number of pixels of each slot to counts[slot]. Counts the pixels of `wanted`, slot by slot, and
  /// stops after four slots. Returns the pixels left.
  uint64_t (*count)(const uint8_t* slots, uint64_t wanted, uint32_t* counts);

  /// See ProbeKernels::find. The indices are slots.
  void (*index)(const uint32_t* pixels, const SlotTable& table, uint16_t* indices, uint8_t* widths);
};

extern const KernelSets<SlotKernels> kSlotKernelSets;
inline const SlotKernels& slot_kernels() {
  return kSlotKernelSets.in_use();
}
#if defined(__x86_64__)
extern const SlotKernels kVbmiSlotKernels;
#endif

/// True if a slot table is the fastest way to find one of `colors` colours.
inline bool slot_table_pays(uint32_t colors) {
  return slot_kernels().byte_permutes && colors <= SlotTable::kSlots;
}

}  // namespace tilepress
