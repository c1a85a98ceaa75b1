// Own thread: a thread of the shim, on a stack that no other thread has had.
#pragma once

#include <pthread.h>

#include <functional>

namespace tilepress {

/// In a forked child the C library reuses the stacks of the parent's threads for new ones, and with a stack
/// its thread's handle. A driver that joins its own threads at the child's end would then wait for one of
/// ours. So our threads bring their own stacks.
class OwnThread {
 public:
  OwnThread() = default;
  OwnThread(const OwnThread&) = delete;
  OwnThread& operator=(const OwnThread&) = delete;
  ~OwnThread() { join(); }
  /// Runs `work` on the thread, with all signals blocked. Returns false if the system has no thread left.
  bool start(const char* name, std::function<void()> work);
  bool started() const { return stack_ != nullptr; }
  /// Waits for the thread to end. start() may follow.
  void join();

 private:
  static void* run(void* work);
  pthread_t thread_{};
  void* stack_ = nullptr;
  std::function<void()> work_;
};

}  // namespace tilepress
