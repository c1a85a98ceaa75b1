// Readback probe: measures over a window's first frames which way of reading costs its thread less.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interposer/engine/readback/captured_frame.h"

namespace tilepress {

/// Reads some frames synchronously, then some both ways (and keeps the synchronous pixels). Chooses
/// asynchronous reads only by a clear margin, and only if they keep it over a trial.
class ReadbackProbe {
 public:
  static constexpr size_t kWarmUp = 4, kSamples = 6;
  static constexpr uint64_t kMarginNs = 100'000;  ///< pays for a thread and a copy
  static constexpr uint64_t kFactor = 2;          ///< how many times cheaper

  /// The way to read the next frame.
  ReadWay next() const;
  /// Notes the way taken and its cost on the thread. For kBoth, `buffered_cost_ns` is the cost of the read
  /// into a pixel buffer (0 = that is not possible). Returns true if this settled or changed the choice.
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
