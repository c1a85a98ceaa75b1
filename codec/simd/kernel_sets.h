// Kernel sets: the ones that this build has.
#pragma once

#include <vector>

#include "simd/kernels.h"

namespace tilepress {

const Kernels& scalar_kernels();
/// The sets compiled by Highway that this processor can run, best first.
std::vector<const Kernels*> highway_kernels();

/// `base`, which this processor can run, with what byte permutes do better; null where it has none (AVX-512
/// VBMI, VBMI2 and GFNI).
const Kernels* byte_permute_kernels(const Kernels& base);

// What there is for byte permutes only, plainly: the definition, and the other sets' own.
bool load_slots_plainly(const uint32_t* top_left, uint32_t stride, uint32_t* pixels, SlotLookups& lookups);
FoundSlots find_slots_plainly(const uint32_t* pixels, const SlotTable& table, uint8_t* slots);
uint64_t count_slots_plainly(const uint8_t* slots, uint64_t wanted, uint32_t* counts);
void index_slots_plainly(const uint32_t* pixels, const SlotTable& table, uint16_t* indices, uint8_t* widths);
uint32_t code_sum_plainly(const uint16_t* indices, const uint8_t* lengths, uint32_t raw_bits);
WrittenBlock write_sub_blocks_plainly(const uint32_t* pixels, const uint16_t* indices, const uint8_t* widths,
                                      uint32_t mark_bits, uint8_t* out);
uint32_t read_indices_plainly(const uint8_t* bytes, const uint64_t marks[2], uint32_t mark_bits,
                              uint32_t most_bits, const uint32_t* colors, uint32_t known, uint32_t* raster);

}  // namespace tilepress
