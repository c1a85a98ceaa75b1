// Surface registry: a short list, searched from the front; programs have few windows.
#include "interposer/engine/surface_registry.h"

#include <algorithm>

namespace tilepress {

SurfaceRegistry::Turn SurfaceRegistry::turn(const WindowKey& key, const SurfaceShape& shape,
                                            uint64_t now_ns) {
  std::lock_guard lock(mutex_);
  std::optional<uint32_t> forgotten;
  auto window = std::find_if(windows_.begin(), windows_.end(), [&](const Window& w) { return w.key == key; });
  if (window == windows_.end()) {
    if (windows_.size() >= kMaxWindows) {
      const auto oldest =
          std::min_element(windows_.begin(), windows_.end(),
                           [](const Window& a, const Window& b) { return a.last_turn < b.last_turn; });
      forgotten = oldest->number;
      windows_.erase(oldest);
    }
    windows_.push_back({key, shape, window_count_++, surface_count_++, 0, 0, 0});
    window = windows_.end() - 1;
  } else if (window->shape != shape) {
    window->shape = shape;
    window->surface = surface_count_++;
    window->frames = 0;
  }
  window->last_turn = ++turns_;
  const uint64_t interval_ns = window->last_ns > 0 ? now_ns - window->last_ns : 0;
  return {window->number, window->surface, window->frames, interval_ns, forgotten};
}

void SurfaceRegistry::presented(uint32_t number, uint64_t begin_ns) {
  std::lock_guard lock(mutex_);
  for (Window& window : windows_) {
    if (window.number != number) continue;
    ++window.frames;
    window.last_ns = begin_ns;
  }
}

std::optional<uint32_t> SurfaceRegistry::forget(const WindowKey& key) {
  std::lock_guard lock(mutex_);
  const auto window =
      std::find_if(windows_.begin(), windows_.end(), [&](const Window& w) { return w.key == key; });
  if (window == windows_.end()) return std::nullopt;
  const uint32_t number = window->number;
  windows_.erase(window);
  return number;
}

bool SurfaceRegistry::first_report(uint32_t surface) {
  std::lock_guard lock(mutex_);
  if (std::find(reported_.begin(), reported_.end(), surface) != reported_.end()) return false;
  reported_.push_back(surface);
  return true;
}

}  // namespace tilepress
