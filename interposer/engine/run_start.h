// Run start: starts the worker at the first frame of the process.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

#include "interposer/engine/shim_log.h"
#include "interposer/engine/source/present_source.h"
#include "interposer/engine/worker/capture_worker.h"
#include "interposer/engine_contract.h"

namespace tilepress {

/// Thread-safe. The references must outlive the object.
class RunStart {
 public:
  RunStart(const RunOptions& options, int64_t pid, ShimLog& log) : options_(options), pid_(pid), log_(log) {}
  /// Returns the worker, and notes the road of the frame. The first call makes the worker, and describes the
  /// run by the command line and by `source`. Returns null if the system gives no thread.
  CaptureWorker* worker(const TilepressPresent& present, const PresentSource& source);
  /// Returns null before the first frame.
  CaptureWorker* worker_if_started() const { return worker_; }
  CaptureCounts& counts() { return counts_; }

 private:
  const RunOptions& options_;
  const int64_t pid_;
  ShimLog& log_;
  CaptureCounts counts_;
  std::mutex mutex_;
  bool failed_ = false;
  std::atomic<CaptureWorker*> worker_{nullptr};  ///< never destroyed: the process may end at any time
};

}  // namespace tilepress
