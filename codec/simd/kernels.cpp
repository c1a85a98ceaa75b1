// Kernels: the choice of a set.
#include "simd/kernels.h"

#include "simd/kernel_sets.h"
#include "tilepress/simd.h"

namespace tilepress {
namespace {

std::vector<const Kernels*> runnable() {
  std::vector<const Kernels*> sets = highway_kernels();
  sets.push_back(&scalar_kernels());
  return sets;
}

}  // namespace

const Kernels& choose_kernels() {
  static const Kernels* best = runnable().front();
  chosen_kernels.store(best, std::memory_order_relaxed);
  return *best;
}

std::vector<std::string_view> simd_targets() {
  std::vector<std::string_view> names;
  for (const Kernels* set : runnable()) names.push_back(set->name);
  return names;
}

std::string_view simd_target() {
  return kernels().name;
}

bool force_simd_target(std::string_view name) {
  for (const Kernels* set : runnable())
    if (name == set->name) {
      chosen_kernels.store(set, std::memory_order_relaxed);
      return true;
    }
  return false;
}

}  // namespace tilepress
