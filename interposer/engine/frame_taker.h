// Frame taker: numbers a frame, reads it, and counts what became of it.
#pragma once

#include <cstdint>
#include <optional>

#include "interposer/engine/read_policy.h"
#include "interposer/engine/shim_log.h"
#include "interposer/engine/shot.h"
#include "interposer/engine/surface_registry.h"
#include "interposer/engine/worker/capture_worker.h"

namespace tilepress {

enum class Outcome : uint32_t { kTaken = 1, kSkipped, kDropped, kUnsupported, kNotCaptured };

/// What became of a frame. commit() counts it; before that, nothing has happened.
struct Take {
  static constexpr uint32_t kNoWindow = ~0u;
  Outcome outcome = Outcome::kNotCaptured;
  uint32_t window = kNoWindow;
  CapturedFrame* frame = nullptr;  ///< null unless the outcome is kTaken
  uint64_t begin_ns = 0;
  SurfaceRole role = SurfaceRole::kPresented;
  bool triggered = false;  ///< by another call than a presenting one
};

/// Thread-safe. The references must outlive the taker. `start_ns`: when the run began.
class FrameTaker {
 public:
  FrameTaker(const RunOptions& options, SurfaceRegistry& registry, ReadPolicy& policy, CaptureCounts& counts,
             ShimLog& log, uint64_t start_ns)
      : options_(options),
        registry_(registry),
        policy_(policy),
        counts_(counts),
        log_(log),
        start_ns_(start_ns) {}

  /// Reads the frame unless it is unwanted. May wait for room in the worker's queue.
  Take take(const Shot& shot, CaptureWorker& worker);
  /// Numbers a frame that cannot be read, and logs the reason once per surface.
  Take miss(const Shot& shot, const Error& reason);
  /// The program has presented the frame: hands it to the worker and counts it.
  void commit(const Take& take, CaptureWorker& worker);
  /// The program has not presented the frame.
  void discard(const Take& take, CaptureWorker& worker);

 private:
  /// Why the frame is not read; empty if it is to be read.
  std::optional<Outcome> refusal(const Shot& shot, const SurfaceRegistry::Turn& turn,
                                 const CaptureWorker& worker);
  Result<void> read(const Shot& shot, const SurfaceRegistry::Turn& turn, CapturedFrame& frame);
  void fill_in(const Shot& shot, const SurfaceRegistry::Turn& turn, CapturedFrame& frame) const;
  void report(uint32_t surface, const std::string& reason);

  const RunOptions& options_;
  SurfaceRegistry& registry_;
  ReadPolicy& policy_;
  CaptureCounts& counts_;
  ShimLog& log_;
  const uint64_t start_ns_;
};

}  // namespace tilepress
