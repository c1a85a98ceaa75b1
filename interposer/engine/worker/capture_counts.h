// Capture counts: how many frames a process has presented, and what became of them.
#pragma once

#include <atomic>
#include <cstdint>

#include "interposer/engine/surface_registry.h"
#include "tilepress/live_page.h"
#include "tilepress/run_directory.h"

namespace tilepress {

/// The counts of one role. Presenting threads raise them; the worker raises `captured`.
class RoleCounts {
 public:
  using Count = std::atomic<uint64_t> LiveCounts::*;
  void raise(Count count, uint64_t by = 1);
  uint64_t seen() const { return counts_.seen; }
  RunCounts now() const { return counts_.now(); }
  /// Copies the counts to `shared` from now on. Null ends that.
  void show_in(LiveCounts* shared);
  /// The program has ended: counts every frame that was seen and left no other trace as not captured.
  void settle();

 private:
  LiveCounts counts_{};
  std::atomic<LiveCounts*> shared_{nullptr};
};

struct CaptureCounts {
  RoleCounts presented, targets;
  std::atomic<uint32_t> roads{0};  ///< a bit for each enum TilepressRoad by which frames have come
  RoleCounts& of(SurfaceRole role) { return role == SurfaceRole::kTarget ? targets : presented; }
};

}  // namespace tilepress
