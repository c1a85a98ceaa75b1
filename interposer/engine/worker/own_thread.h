// Own thread: a thread of the shim, on a stack that was never another's.
#pragma once

#include <pthread.h>

#include <functional>

namespace tilepress {

/// In a forked child the C library gives the stacks of threads that are no more to new ones, and with the
/// stack a thread's handle: a driver that joins its own threads when the child ends would join one of ours
/// and wait for good. So ours bring their stacks along.
class OwnThread {
 public:
  OwnThread() = default;
  OwnThread(const OwnThread&) = delete;
  OwnThread& operator=(const OwnThread&) = delete;
  ~OwnThread() { join(); }
  /// Runs `work` on the thread, with all signals blocked. False if the system gives none.
  bool start(const char* name, std::function<void()> work);
  bool started() const { return stack_ != nullptr; }
  bool is_current() const { return started() && pthread_equal(thread_, pthread_self()) != 0; }
  /// Waits for its end. It may be started again then.
  void join();

 private:
  static void* run(void* work);
  pthread_t thread_{};
  void* stack_ = nullptr;
  std::function<void()> work_;
};

}  // namespace tilepress
