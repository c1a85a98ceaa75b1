// CPU target: what this machine runs, and the choice.
#include "cpu/cpu_target.h"

#include "cpu/highway_targets.h"
#include "tilepress/simd.h"

namespace tilepress {
namespace {

struct NamedTarget {
  CpuTarget target;
  std::string_view name;
};

// Highway's own dispatcher lives in a shared library. The engine runs inside other programs and must not
// bring libraries along, so the choice is made here.
std::vector<NamedTarget> runnable_targets() {
  std::vector<NamedTarget> targets;
#if HWY_ARCH_X86
  __builtin_cpu_init();
#if HWY_TARGETS & HWY_AVX3
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512cd")) {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2") &&
        __builtin_cpu_supports("avx512vpopcntdq") && __builtin_cpu_supports("bmi2") &&
        __builtin_cpu_supports("gfni"))
      targets.push_back({CpuTarget::kAvx512Vbmi, "avx512vbmi"});
#endif
    targets.push_back({CpuTarget::kAvx512, "avx512"});
  }
#endif
#if HWY_TARGETS & HWY_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    targets.push_back({CpuTarget::kAvx2, "avx2"});
#endif
#if HWY_TARGETS & HWY_SSE4
  if (__builtin_cpu_supports("sse4.1") && __builtin_cpu_supports("sse4.2"))
    targets.push_back({CpuTarget::kSse4, "sse4"});
#endif
#elif HWY_ARCH_ARM_A64
  targets.push_back({CpuTarget::kNeon, "neon"});
#endif
  targets.push_back({CpuTarget::kScalar, "scalar"});
  return targets;
}

}  // namespace

CpuTarget choose_cpu_target() {
  static const CpuTarget best = runnable_targets().front().target;
  chosen_cpu_target.store(best, std::memory_order_relaxed);
  return best;
}

std::vector<std::string_view> simd_targets() {
  std::vector<std::string_view> names;
  for (const NamedTarget& each : runnable_targets()) names.push_back(each.name);
  return names;
}

std::string_view simd_target() {
  const CpuTarget in_use = cpu_target();
  for (const NamedTarget& each : runnable_targets())
    if (each.target == in_use) return each.name;
  return {};
}

bool force_simd_target(std::string_view name) {
  for (const NamedTarget& each : runnable_targets())
    if (each.name == name) {
      chosen_cpu_target.store(each.target, std::memory_order_relaxed);
      return true;
    }
  return false;
}

}  // namespace tilepress
