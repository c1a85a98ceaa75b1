// Replay batch: many traces, some at a time, and the means over them.
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

/// A batch's frames so far.
struct BatchProgress {
  uint64_t frames_done = 0;
  /// Over all traces that can be replayed; none until all are read.
  std::optional<uint64_t> frames_wanted;
};

class ReplayBatch {
 public:
  /// The options must outlive the batch.
  ReplayBatch(const std::vector<ReplayInput>& inputs, const ReplayOptions& options);
  /// Reads all traces, and replays those that can be, `jobs` at a time, as soon as they are read; the first
  /// need not even wait for that. A trace that fails does not stop the others. `tick` is called ten times a
  /// second or so, from this thread. Returns early, with the replays at work interrupted, once `stop` is not
  /// 0: the number of the signal that ends us.
  void run(unsigned jobs, const std::atomic<int>& stop,
           const std::function<void(const BatchProgress&)>& tick);
  /// In the order of the inputs.
  const std::vector<std::unique_ptr<TraceReplay>>& replays() const { return replays_; }

 private:
  std::vector<std::unique_ptr<TraceReplay>> replays_;
};

/// Mean of one scheme over the traces of one category (spec §7): harmonic, each trace counting the same.
struct CategoryMean {
  std::string category;  ///< empty: over all traces
  std::string scheme;
  uint64_t traces = 0;
  double rate = 0, rate_payload = 0;
};

/// Over the traces that were captured in full and have measured frames; categories in order of first
/// occurrence, at the end all traces together.
std::vector<CategoryMean> category_means(const std::vector<std::unique_ptr<TraceReplay>>& replays);

}  // namespace tilepress
