// Replay batch: replays many traces, some at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tilepress/trace_replay.h"

namespace tilepress {

struct BatchProgress {
  uint64_t frames_done = 0;
  /// Over all traces that can be replayed; none until all traces are read.
  std::optional<uint64_t> frames_wanted;
};

class ReplayBatch {
 public:
  /// The options must outlive the batch.
  ReplayBatch(const std::vector<ReplayInput>& inputs, const ReplayOptions& options);
  /// Reads the traces in order and replays them, `jobs` at a time. The first `jobs` replays start before
  /// their traces are read. A trace that fails does not stop the others. Calls `tick` about ten times a
  /// second from this thread. Once `stop` holds the number of a signal, interrupts the replays and returns.
  void run(unsigned jobs, const std::atomic<int>& stop,
           const std::function<void(const BatchProgress&)>& tick);
  /// In the order of the inputs.
  const std::vector<std::unique_ptr<TraceReplay>>& replays() const { return replays_; }

 private:
  std::vector<std::unique_ptr<TraceReplay>> replays_;
};

}  // namespace tilepress
