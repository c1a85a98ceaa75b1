// Yielding thread: waits for work on a condition.
#include "interposer/engine/worker/yielding_thread.h"

#include <sched.h>

#include <utility>

#include "interposer/system_calls.h"

namespace tilepress {

static uint64_t thread_cpu_ns() {
  return clock_ns(CLOCK_THREAD_CPUTIME_ID);
}

void YieldingThread::end() {
  if (!thread_.started()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

YieldingThread::Turn YieldingThread::run(const std::function<void()>& work) {
  if (!thread_.started() && !thread_.start("tilepress-calm", [this] { serve(); })) {
    work();
    return {};
  }
  std::unique_lock lock(mutex_);
  work_ = &work;
  changed_.notify_all();
  while (work_ != nullptr) changed_.wait(lock);
  if (const std::exception_ptr thrown = std::exchange(thrown_, nullptr)) std::rethrow_exception(thrown);
  return turn_;
}

void YieldingThread::serve() {
  const sched_param none{};
  sched_setscheduler(0, SCHED_IDLE, &none);  // on Linux this sets the calling thread's class
  std::unique_lock lock(mutex_);
  for (;;) {
    while (work_ == nullptr && !ended_) changed_.wait(lock);
    if (work_ == nullptr) return;
    lock.unlock();
    const uint64_t begin_ns = now_ns(), begin_cpu_ns = thread_cpu_ns();
    std::exception_ptr thrown;
    try {
      (*work_)();
    } catch (...) {
      thrown = std::current_exception();
    }
    const Turn turn{now_ns() - begin_ns, thread_cpu_ns() - begin_cpu_ns};
    lock.lock();
    turn_ = turn;
    thrown_ = thrown;
    work_ = nullptr;
    changed_.notify_all();
  }
}

}  // namespace tilepress
