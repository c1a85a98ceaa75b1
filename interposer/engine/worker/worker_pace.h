// Worker pace: decides for each frame whether the worker yields to the program's threads.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tilepress {

/// While the worker keeps up, it works in the gaps that the program leaves: a software renderer uses every
/// core, and each core taken from it delays the frame. When frames pile up, the worker runs at full priority,
/// or the program would wait for it. Under the load of other programs, work that yields may get almost no
/// time. If that has held the program up, the worker stops yielding for a while, each time for longer.
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
