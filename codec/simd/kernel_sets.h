// Kernel sets: the ones that this build has.
#pragma once

#include <vector>

#include "simd/kernels.h"

namespace tilepress {

const Kernels& scalar_kernels();
/// The sets compiled by Highway that this processor can run, best first.
std::vector<const Kernels*> highway_kernels();

}  // namespace tilepress
