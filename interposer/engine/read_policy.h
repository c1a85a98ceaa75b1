// Read policy: which way a frame is read: in place, synchronously, or late through a pixel buffer.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "interposer/engine/readback/captured_frame.h"
#include "tilepress/run_options.h"

namespace tilepress {

/// Measures over a window's first frames which way of reading costs its thread less.
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

/// What the way depends on.
struct ReadCase {
  uint32_t window;
  uint64_t pixels;
  bool may_be_late;      ///< the pixels may arrive after the call
  bool software_window;  ///< as Shot::software_window
  bool new_shape;        ///< the window has presented nothing at this size yet
};

/// --readback, and for `auto` a probe per window. Thread-safe.
class ReadPolicy {
 public:
  explicit ReadPolicy(Readback wish) : wish_(wish) {}
  /// The way to read the next frame. `auto` probes a window again when it has become more than twice as large
  /// or less than half as large.
  ReadWay way(const ReadCase& read);
  /// A frame was read. Returns a line for the log if that settled the window's choice, else an empty one.
  std::string note(const ReadCase& read, const CapturedFrame& frame);
  void forget(uint32_t window);

 private:
  struct Choice {
    ReadbackProbe probe;
    uint64_t pixels = 0;
  };
  bool in_place(const ReadCase& read) const;
  const Readback wish_;
  std::mutex mutex_;
  std::map<uint32_t, Choice> choices_;  ///< by window
};

}  // namespace tilepress
