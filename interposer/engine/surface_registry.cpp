// Surface registry: a short list, searched from the front; programs have few windows.
#include "interposer/engine/surface_registry.h"

#include <algorithm>

namespace tilepress {

SurfaceRegistry::Turn SurfaceRegistry::turn(const WindowKey& key, const SurfaceShape& shape,
                                            uint64_t now_ns) {
  std::lock_guard lock(mutex_);
  std::optional<uint32_t> forgotten;
  auto window = std::find_if(windows_.begin(), windows_.end(), [&](const Window& w) { return w.key == key; });
  const bool target = key.role == SurfaceRole::kTarget;
  uint32_t& next_surface = target ? target_count_ : surface_count_;
  if (window == windows_.end()) {
    const auto alike = [&](const Window& w) { return w.key.role == key.role; };
    const auto count = static_cast<size_t>(std::count_if(windows_.begin(), windows_.end(), alike));
    if (count >= (target ? kMaxTargets : kMaxWindows)) {
      auto oldest = std::find_if(windows_.begin(), windows_.end(), alike);
      for (auto other = oldest; other != windows_.end(); ++other)
        if (alike(*other) && other->last_turn < oldest->last_turn) oldest = other;
      forgotten = oldest->number;
      windows_.erase(oldest);
    }
    windows_.push_back({key, shape, window_count_++, next_surface++, 0, 0, 0, true});
    window = windows_.end() - 1;
  } else if (window->shape != shape) {
    window->shape = shape;
    window->surface = next_surface++;
    window->frames = 0;
    window->new_shape = true;
  }
  window->last_turn = ++turns_;
  const uint64_t interval_ns = window->last_ns > 0 ? now_ns - window->last_ns : 0;
  return {window->number, window->surface, window->frames, interval_ns, forgotten, window->new_shape};
}

void SurfaceRegistry::presented(uint32_t number, uint64_t begin_ns, bool triggered) {
  std::lock_guard lock(mutex_);
  for (Window& window : windows_) {
    if (window.number != number) continue;
    ++window.frames;
    window.new_shape &= triggered;
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

std::vector<uint32_t> SurfaceRegistry::forget_targets(const void* context, uintptr_t image, uintptr_t mask) {
  std::lock_guard lock(mutex_);
  std::vector<uint32_t> numbers;
  std::erase_if(windows_, [&](const Window& window) {
    const bool gone = window.key.display == context && window.key.role == SurfaceRole::kTarget &&
                      ((window.key.surface ^ image) & mask) == 0;
    if (gone) numbers.push_back(window.number);
    return gone;
  });
  return numbers;
}

bool SurfaceRegistry::first_report(uint32_t surface) {
  std::lock_guard lock(mutex_);
  if (std::find(reported_.begin(), reported_.end(), surface) != reported_.end()) return false;
  reported_.push_back(surface);
  return true;
}

}  // namespace tilepress
