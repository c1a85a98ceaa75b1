// Plain lock: a mutex and a condition on futexes alone.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

namespace tilepress {

/// The C library's own are replaced by other preloaded libraries, and know no owner that is gone. Only tasks
/// that share this memory may use it.
class PlainMutex {
 public:
  void lock();
  void unlock();
  bool try_lock();
  bool try_lock_for(uint64_t patience_ns);
  /// Takes the mutex from an owner that is gone. Precondition: no other thread is left that could want it.
  void take_over() { word_.store(kHeld, std::memory_order_relaxed); }

 private:
  static constexpr uint32_t kFree = 0, kHeld = 1, kAwaited = 2;
  std::atomic<uint32_t> word_{kFree};
};

class PlainCondition {
 public:
  static constexpr uint64_t kForever = UINT64_MAX;
  /// Returns after notify_all(), after `patience_ns`, or for no reason.
  void wait(std::unique_lock<PlainMutex>& lock, uint64_t patience_ns = kForever);
  /// The same in parts, for a caller that takes the mutex again in its own way.
  uint32_t turn() const { return turn_.load(std::memory_order_relaxed); }
  void wait_past(uint32_t turn, uint64_t patience_ns);
  void notify_all();

 private:
  std::atomic<uint32_t> turn_{0};
};

}  // namespace tilepress
