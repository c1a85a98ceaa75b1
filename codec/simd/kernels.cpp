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

const Kernels*& chosen() {
  static const Kernels* set = runnable().front();
  return set;
}

}  // namespace

const Kernels& kernels() {
  return *chosen();
}

std::vector<std::string_view> simd_targets() {
  std::vector<std::string_view> names;
  for (const Kernels* set : runnable()) names.push_back(set->name);
  return names;
}

std::string_view simd_target() {
  return chosen()->name;
}

bool force_simd_target(std::string_view name) {
  for (const Kernels* set : runnable())
    if (name == set->name) {
      chosen() = set;
      return true;
    }
  return false;
}

}  // namespace tilepress
