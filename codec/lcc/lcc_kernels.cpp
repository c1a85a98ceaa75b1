#include "lcc/lcc_kernels.h"

namespace tilepress {

constexpr LccKernels kPlainLccKernels = {
    .find_planes = [](const LccPlane<uint32_t>& pixels, LccPlanes& out) { lcc::find_planes(pixels, out); }};

}  // namespace tilepress
