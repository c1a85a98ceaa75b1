// LCC kernels: the planes of a block.
#pragma once

#include "cpu/cpu_target.h"
#include "lcc/lcc_planes.h"

namespace tilepress {

struct LccKernels {
  /// `pixels` are in raster order.
  void (*find_planes)(const LccPlane<uint32_t>& pixels, LccPlanes& out);
};

extern const LccKernels kPlainLccKernels;
extern const KernelSets<LccKernels> kLccKernelSets;
inline const LccKernels& lcc_kernels() {
  return kLccKernelSets.in_use();
}

}  // namespace tilepress
