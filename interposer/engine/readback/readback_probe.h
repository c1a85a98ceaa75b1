// Readback probe: which way of reading costs a window's thread less, found out over its first frames.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "interposer/engine/readback/captured_frame.h"
#include "tilepress/run_options.h"

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

/// The choice of every window. Thread-safe.
class ReadbackChoices {
 public:
  explicit ReadbackChoices(Readback wish) : wish_(wish) {}
  /// How to read the window's next frame, of `pixels` pixels. A window is probed again when it has become
  /// more than twice as large or less than half as large since.
  ReadWay way(uint32_t window, uint64_t pixels);
  /// A frame was read. One line for the log when that settled the choice, else empty.
  std::string note(uint32_t window, const CapturedFrame& frame);
  void forget(uint32_t window);

 private:
  struct Choice {
    ReadbackProbe probe;
    uint64_t pixels = 0;
  };
  const Readback wish_;
  std::mutex mutex_;
  std::map<uint32_t, Choice> choices_;
};

}  // namespace tilepress
