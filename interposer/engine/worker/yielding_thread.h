// Yielding thread: runs one piece of work at a time, when the machine has nothing more urgent to do.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>

#include "interposer/engine/worker/own_thread.h"
#include "interposer/engine/worker/plain_lock.h"

namespace tilepress {

/// A thread that gets the cores nobody else wants (SCHED_IDLE): others are scheduled as if it were not there.
/// One that lowers its own priority may not raise it again without privileges, so work that is to be done at
/// either priority needs a thread for each. `work` must hold no lock that others may wait for.
class YieldingThread {
 public:
  struct Turn {
    uint64_t wall_ns = 0, cpu_ns = 0;
  };
  ~YieldingThread() { end(); }
  /// Has `work` done and waits for it; what it throws is thrown here. Starts the thread, with all
  /// signals blocked, at first use; works itself where the system gives no thread.
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

}  // namespace tilepress
