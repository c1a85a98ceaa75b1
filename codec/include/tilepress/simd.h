// SIMD targets: which instruction set the kernels use. Every target gives the same bits.
#pragma once

#include <string_view>
#include <vector>

namespace tilepress {

/// Names of the targets this machine can run, best first; the last is "scalar", the plain definition.
std::vector<std::string_view> simd_targets();
/// The target in use: the best one unless forced.
std::string_view simd_target();
/// Uses `name` from now on, in engines opened later. False: no such target on this machine.
/// Not thread-safe; call it before engines are made.
bool force_simd_target(std::string_view name);

}  // namespace tilepress
