// Surface registry: a short list, searched from the front; programs have few windows.
#include "interposer/engine/surface_registry.h"

#include <algorithm>

namespace tilepress {

SurfaceRegistry::Turn SurfaceRegistry::turn(const WindowKey& key, const SurfaceShape& shape) {
  std::lock_guard lock(mutex_);
  auto window = std::find_if(windows_.begin(), windows_.end(), [&](const Window& w) { return w.key == key; });
  if (window == windows_.end()) {
    windows_.push_back({key, shape, surface_count_++, 0});
    window = windows_.end() - 1;
  } else if (window->shape != shape) {
    *window = {key, shape, surface_count_++, 0};
  }
  return {static_cast<uint32_t>(window - windows_.begin()), window->surface, window->frames};
}

void SurfaceRegistry::presented(uint32_t window) {
  std::lock_guard lock(mutex_);
  ++windows_[window].frames;
}

bool SurfaceRegistry::first_report(uint32_t surface) {
  std::lock_guard lock(mutex_);
  if (std::find(reported_.begin(), reported_.end(), surface) != reported_.end()) return false;
  reported_.push_back(surface);
  return true;
}

}  // namespace tilepress
