// CPU target: the instruction set in use, and the versions of a family of kernels by target.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tilepress {

enum class CpuTarget : uint8_t { kScalar, kNeon, kSse4, kAvx2, kAvx512, kAvx512Vbmi, kNotChosen };
constexpr size_t kCpuTargets = static_cast<size_t>(CpuTarget::kNotChosen);

inline std::atomic<CpuTarget> chosen_cpu_target = CpuTarget::kNotChosen;
/// Chooses the best target of this machine.
CpuTarget choose_cpu_target();
inline CpuTarget cpu_target() {
  const CpuTarget chosen = chosen_cpu_target.load(std::memory_order_relaxed);
  return chosen != CpuTarget::kNotChosen ? chosen : choose_cpu_target();
}

/// A kernel is an inner loop with one version per target. Kernels that belong together share a struct of
/// function pointers. The plain version defines the result; each faster version returns the same bits.
template <class Kernels>
struct KernelSets {
  std::array<const Kernels*, kCpuTargets> by_target;

  const Kernels& in_use() const { return *by_target[static_cast<size_t>(cpu_target())]; }
};

/// The versions of a family that has byte-permute kernels (cpu/vbmi.h) and plain ones only.
template <class Kernels>
constexpr KernelSets<Kernels> plain_and_vbmi(const Kernels& plain, const Kernels& vbmi) {
  return {{&plain, &plain, &plain, &plain, &plain, &vbmi}};
}

}  // namespace tilepress
