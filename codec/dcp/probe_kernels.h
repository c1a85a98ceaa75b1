// Probe kernels: 64 pixels looked up in a probe table, and what the collector does with its table's answers.
#pragma once

#include "cpu/cpu_target.h"
#include "dcp/probe_table.h"
#include "pixels/few_colors.h"

namespace tilepress {

struct Smallest {
  uint32_t at;        ///< the first of the smallest values
  uint32_t smallest;  ///< its value
  uint32_t second;    ///< the smallest of the other values
};

struct ProbeKernels {
  /// indices[i] = the table's value of pixels[i], or kNotInCcd. widths[s] = the bit width of the largest
  /// index of sub-block s, or kRawWidth if the table lacks one of its pixels. The table is collision-free.
  void (*find)(const uint32_t* pixels, const ProbeTable& table, uint16_t* indices, uint8_t* widths);

  /// The same for a block of few colours with known values.
  void (*find_few)(const uint32_t* pixels, const FewColors& few, const uint32_t* few_values,
                   uint16_t* indices, uint8_t* widths);

  /// Bit i of the result: pixels[i] is in the table or one of the `crowded` colours. places[i] = its bucket,
  /// or table size + 1 + its number among the crowded colours, or table size if it is neither.
  uint64_t (*members)(const uint32_t* pixels, const ProbeTable& table, const uint32_t* crowded_colors,
                      uint32_t crowded, uint32_t* places);

  /// Finds the smallest of 64 values. Value i is the sum of counts[i + n · stride] for n = 0 … 3.
  Smallest (*find_smallest)(const uint32_t* counts, uint32_t stride);

  /// Packs the pixels whose bit of `mask` is set to out[0], out[1], ... in order. May overwrite the rest up
  /// to out[79]. Bit i of the result: out[i] equals the one before it; out[0] is compared with `before`.
  uint64_t (*compact)(const uint32_t* pixels, uint64_t mask, uint32_t before, uint32_t* out);
};

/// See ProbeKernels::compact.
uint64_t compact_plainly(const uint32_t* pixels, uint64_t mask, uint32_t before, uint32_t* out);
#if defined(__x86_64__)
uint64_t compact_by_avx512(const uint32_t* pixels, uint64_t mask, uint32_t before, uint32_t* out);
#endif
extern const ProbeKernels kPlainProbeKernels;
extern const KernelSets<ProbeKernels> kProbeKernelSets;
inline const ProbeKernels& probe_kernels() {
  return kProbeKernelSets.in_use();
}

}  // namespace tilepress
