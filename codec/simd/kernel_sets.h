// Kernel sets: the ones that this build has.
#pragma once

#include <vector>

#include "simd/kernels.h"

namespace tilepress {

const Kernels& scalar_kernels();
/// The sets compiled by Highway that this processor can run, best first.
std::vector<const Kernels*> highway_kernels();

/// `base`, which this processor can run, with what byte permutes do better; null where it has none (AVX-512
/// VBMI and VBMI2).
const Kernels* byte_permute_kernels(const Kernels& base);

// Where there are no byte permutes, slots are found as they are defined.
FoundSlots find_slots_plainly(const BlockKeys& keys, const SlotTable& table, uint8_t* slots);
void index_slots_plainly(const BlockKeys& keys, const SlotTable& table, uint16_t* indices, uint8_t* widths);

}  // namespace tilepress
