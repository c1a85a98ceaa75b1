// Readback probe: which way of reading costs a window's thread less, found out over its first frames.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interposer/engine/readback/captured_frame.h"

namespace tilepress {

/// First some frames synchronously, then some both ways (their pixels are the synchronous ones). Asynchronous
/// reads are chosen only by a clear margin, and have to keep what they promised over the first frames.
class ReadbackProbe {
 public:
  static constexpr size_t kWarmUp = 4, kSamples = 6;
  static constexpr uint64_t kMarginNs = 100'000;  ///< worth a thread and a copy
  static constexpr uint64_t kFactor = 2;          ///< how many times cheaper

  /// The way to read the next frame.
  ReadWay next() const;
  /// What came of it: the way it was read, what that cost the thread, and of kBoth what the read into a pixel
  /// buffer would have cost (0 = it cannot be done). True if this settled or changed the choice.
  bool note(ReadWay way, uint64_t cost_ns, uint64_t buffered_cost_ns);
  /// "synchronous reads 0.20 ms, into pixel buffers 0.19 ms: synchronous".
  std::string text() const;

 private:
  enum class State { kSync, kBoth, kTrial, kChosenSync, kChosenAsync };
  bool settle(State state);
  bool pays(const std::vector<uint64_t>& buffered_ns) const;
  State state_ = State::kSync;
  size_t passed_over_ = 0;
  std::vector<uint64_t> sync_ns_, buffered_ns_, trial_ns_;
};

}  // namespace tilepress
