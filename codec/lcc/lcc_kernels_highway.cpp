// LCC kernels per target: the plain loops, compiled for each instruction set.
#include "cpu/highway_targets.h"
#include "lcc/lcc_kernels.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lcc/lcc_kernels_highway.cpp"
#include "hwy/foreach_target.h"  // before Highway's other headers

#include "cpu/highway.h"

#if TILEPRESS_HAS_SIMD
TILEPRESS_HIGHWAY_BEGIN

void FindPlanes(const LccPlane<uint32_t>& pixels, LccPlanes& out) {
  lcc::find_planes(pixels, out);
}

constexpr LccKernels kLccKernels = {.find_planes = FindPlanes};

TILEPRESS_HIGHWAY_END
#endif

#if HWY_ONCE
namespace tilepress {

constexpr KernelSets<LccKernels> kLccKernelSets =
    TILEPRESS_KERNEL_SETS(kPlainLccKernels, kLccKernels, TILEPRESS_AVX512_OR(kPlainLccKernels, kLccKernels));

}  // namespace tilepress
#endif
