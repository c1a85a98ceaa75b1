// Yielding thread: runs work in the idle class, one piece at a time.
#pragma once

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

}  // namespace tilepress
