// Yielding thread: runs work in the idle class, one piece at a time, and decides for which frames.
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <functional>

#include "interposer/engine/worker/own_thread.h"
#include "interposer/engine/worker/plain_lock.h"

namespace tilepress {

/// A thread of the class SCHED_IDLE gets only cores that no other thread wants. A thread that lowers its
/// priority may not raise it again without privileges, so each of the two priorities needs a thread of its
/// own. `work` must hold no lock that others may wait for.
class YieldingThread {
 public:
  struct Turn {
    uint64_t wall_ns = 0, cpu_ns = 0;
  };
  ~YieldingThread() { end(); }
  /// Runs `work` on the thread and waits for it. Rethrows what `work` throws. The first call starts the
  /// thread, with all signals blocked. Without a thread, runs `work` on the calling one.
  Turn run(const std::function<void()>& work);
  void end();

 private:
  void serve();

  PlainMutex mutex_;
  PlainCondition changed_;
  const std::function<void()>* work_ = nullptr;  ///< null: nothing to do
  bool ended_ = false;
  std::exception_ptr thrown_;
  Turn turn_;
  OwnThread thread_;
};

/// Decides for each frame whether the worker yields. While the worker keeps up, it works in the gaps that the
/// program leaves: a software renderer uses every core, and each core taken from it delays the frame. When
/// frames pile up, the worker runs at full priority, or the program would wait for it. Under the load of
/// other programs, work that yields may get almost no time. If that has held the program up, the worker stops
/// yielding for a while, each time for longer.
class WorkerPace {
 public:
  static constexpr uint32_t kFirstRest = 16, kLongestRest = 4096;  ///< frames
  static constexpr uint64_t kStarved = 10;                         ///< wall time over CPU time

  /// `pending`: frames not finished, of at most `depth`, with the one at hand. The worker calls it again
  /// during a frame: the rest of the frame may run at full priority.
  bool yields(uint32_t pending, uint32_t depth) const {
    return rest_ == 0 && pending <= std::max(1u, depth / 2);
  }
  /// The worker finished a frame while yielding. `held_up`: the queue is full now.
  void yielded(uint64_t wall_ns, uint64_t cpu_ns, bool held_up) {
    if (!held_up || wall_ns <= kStarved * cpu_ns) return;
    rest_ = next_rest_;
    next_rest_ = std::min(2 * next_rest_, kLongestRest);
  }
  /// The worker finished a frame at full priority.
  void hurried() { rest_ -= std::min(rest_, 1u); }

 private:
  uint32_t rest_ = 0, next_rest_ = kFirstRest;
};

}  // namespace tilepress
