// Histogram kernels: runs of pixels into a table of colour counts.
#pragma once

#include "cpu/cpu_target.h"
#include "statistics/color_buckets.h"

namespace tilepress {

struct HistogramKernels {
  /// Bit i of `begins` is set if a run of pixels of one colour begins at pixel i. The last run ends before
  /// `end`. Adds the length of each run to the count of its colour if the colour's own bucket holds the
  /// colour. Returns the beginnings of the other runs.
  uint64_t (*count_runs)(const uint32_t* pixels, uint64_t begins, uint32_t end, ColorBucket* table,
                         size_t buckets);
};

extern const HistogramKernels kPlainHistogramKernels;
extern const KernelSets<HistogramKernels> kHistogramKernelSets;
inline const HistogramKernels& histogram_kernels() {
  return kHistogramKernelSets.in_use();
}

}  // namespace tilepress
