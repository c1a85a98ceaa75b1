// Read policy: which way a frame is read: in place, synchronously, or late through a pixel buffer.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/readback/readback_probe.h"
#include "tilepress/run_options.h"

namespace tilepress {

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
