// Worker pace: decides frame by frame whether the worker lets the program's threads go first.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tilepress {

/// While the worker keeps up, it does best in the gaps that the program leaves: whoever renders in software
/// has as many threads as there are cores, and each core taken from them delays the frame. When frames pile
/// up it works at full priority, or the program would wait for it. Under the load of others, work that yields
/// may get next to nothing done: where that held the program up, the worker does not yield for a good while,
/// each time for longer.
class WorkerPace {
 public:
  static constexpr uint32_t kFirstRest = 16, kLongestRest = 4096;  ///< frames
  static constexpr uint64_t kStarved = 10;                         ///< wall time over CPU time

  /// `pending`: frames not finished, the one at hand among them, of at most `depth`. Asked again while a
  /// frame is at hand: the rest of it may be done at full priority.
  bool yields(uint32_t pending, uint32_t depth) const {
    return rest_ == 0 && pending <= std::max(1u, depth / 2);
  }
  /// A frame was done yielding, in so much time; `held_up`: the queue is full now.
  void yielded(uint64_t wall_ns, uint64_t cpu_ns, bool held_up) {
    if (!held_up || wall_ns <= kStarved * cpu_ns) return;
    rest_ = next_rest_;
    next_rest_ = std::min(2 * next_rest_, kLongestRest);
  }
  /// A frame was done at full priority.
  void hurried() { rest_ -= std::min(rest_, 1u); }

 private:
  uint32_t rest_ = 0, next_rest_ = kFirstRest;
};

}  // namespace tilepress
