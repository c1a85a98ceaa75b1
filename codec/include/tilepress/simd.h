// SIMD targets: the instruction set that the kernels use. Every target returns the same bits.
#pragma once

#include <string_view>
#include <vector>

namespace tilepress {

/// Returns the targets that this machine runs, the best first; the last is "scalar", the plain definition.
std::vector<std::string_view> simd_targets();
/// Returns the target in use: the best one unless forced.
std::string_view simd_target();
/// Engines made from now on use `name`. Returns false if this machine has no such target. Not thread-safe:
/// call it before engines are made.
bool force_simd_target(std::string_view name);

}  // namespace tilepress
