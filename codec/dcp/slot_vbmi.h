// Slot kernels by AVX-512 VBMI, and the collector's packing of pixels.
#pragma once

#include "dcp/slot_kernels.h"

#if defined(__x86_64__)

namespace tilepress {

extern const SlotKernels kVbmiSlotKernels;
/// See ProbeKernels::compact.
uint64_t compact_by_vbmi(const uint32_t* pixels, uint64_t mask, uint32_t before, uint32_t* out);

}  // namespace tilepress
#endif
