// Capture: everything the shim knows in one process, from the first presenting call on.
#pragma once

#include <cstdint>
#include <mutex>
#include <set>
#include <string>

#include "interposer/engine/frame_taker.h"
#include "interposer/engine/read_policy.h"
#include "interposer/engine/run_start.h"
#include "interposer/engine/shim_log.h"
#include "interposer/engine/source_list.h"
#include "interposer/engine/surface_registry.h"
#include "interposer/engine/target_capture.h"
#include "interposer/engine/worker/run_tables.h"
#include "tilepress/run_options.h"

namespace tilepress {

/// Belongs to one process id. A forked child makes its own and leaves the parent's alone, locks and all. The
/// members of the same names in TilepressEngine have the contracts.
class Capture {
 public:
  explicit Capture(const TilepressHost& host);
  int64_t pid() const { return pid_; }

  /// Captures a frame, and takes the times for --measure-overhead.
  bool begin(TilepressPresent& present);
  void end(TilepressPresent& present, bool presented);
  void gl_call(const TilepressGlCall& call);
  void contexts_going(uint32_t api, void* display, void* context);
  void surface_going(void* display, uintptr_t surface);
  void finish();

 private:
  bool is_capturing() const;
  bool take_present(TilepressPresent& present, uint64_t begin_ns);
  Take not_described(const TilepressPresent& present, const Error& reason);

  const int64_t pid_;
  RunOptions options_;        ///< those of the environment
  const Result<void> valid_;  ///< the environment
  const bool counting_only_;  ///< TILEPRESS_CAPTURE=off
  ShimLog log_;
  PresentTimes times_;
  SurfaceRegistry registry_;
  ReadPolicy policy_;
  SourceList sources_;
  RunStart run_;
  FrameTaker taker_;
  TargetCapture targets_;
  std::mutex mutex_;  ///< guards warned_
  std::set<std::string> warned_;
};

}  // namespace tilepress
