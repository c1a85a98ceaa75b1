// Slot kernels, plainly: the definition.
#include "dcp/slot_kernels.h"

#include <bit>

#include "dcp/index_widths.h"
#include "pixels/pixel_kernels.h"

namespace tilepress {
namespace {

FoundSlots find(const uint32_t* pixels, const SlotTable& table, uint8_t* slots) {
  FoundSlots found = {0, 1};
  for (uint32_t i = 0; i < kBlockPixels; ++i) {
    slots[i] = static_cast<uint8_t>(table.find(pixels[i]));
    found.known |= uint64_t{slots[i] != SlotTable::kAbsent} << i;
    if (i > 0) found.begins |= uint64_t{slots[i] != slots[i - 1]} << i;
  }
  if (found.known == 0) found.begins = kPlainPixelKernels.run_begins(pixels);
  return found;
}

uint64_t count(const uint8_t* slots, uint64_t wanted, uint32_t* counts) {
  for (uint32_t n = 0; n < 4 && wanted != 0; ++n) {
    const uint8_t slot = slots[std::countr_zero(wanted)];
    for (uint32_t i = 0; i < kBlockPixels; ++i) {
      if ((wanted >> i & 1) == 0 || slots[i] != slot) continue;
      ++counts[slot];
      wanted &= ~(uint64_t{1} << i);
    }
  }
  return wanted;
}

void index(const uint32_t* pixels, const SlotTable& table, uint16_t* indices, uint8_t* widths) {
  uint8_t slots[kBlockPixels];
  find(pixels, table, slots);
  for (uint32_t i = 0; i < kBlockPixels; ++i)
    indices[i] = slots[i] == SlotTable::kAbsent ? kNotInCcd : slots[i];
  fill_widths(indices, widths);
}

bool load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels, const SlotLookups& lookups) {
  if (kPlainPixelKernels.load_traversal(top_left, stride, pixels)) return true;
  for (const IndexLookup& each : lookups.dictionaries) index(pixels, *each.table, each.indices, each.widths);
  for (MemberLookup* each : lookups.members) each->found = find(pixels, *each->table, each->slots);
  return false;
}

constexpr SlotKernels kPlainSlotKernels = {
    .byte_permutes = false, .load = load, .find = find, .count = count, .index = index};

}  // namespace

#if defined(__x86_64__)
const KernelSets<SlotKernels> kSlotKernelSets = plain_and_vbmi(kPlainSlotKernels, kVbmiSlotKernels);
#else
const KernelSets<SlotKernels> kSlotKernelSets = plain_and_vbmi(kPlainSlotKernels, kPlainSlotKernels);
#endif

}  // namespace tilepress
