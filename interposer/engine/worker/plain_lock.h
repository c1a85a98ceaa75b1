// Plain lock: a mutex and a condition on futexes alone.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

namespace tilepress {

/// Other preloaded libraries replace the C library's mutexes, and those cannot be taken from an owner that is
/// gone. Only tasks that share this memory may use it.
class PlainMutex {
 public:
  void lock();
  void unlock();
  bool try_lock();
  bool try_lock_for(uint64_t patience_ns);
  /// Takes the mutex from an owner that is gone. No other thread that uses the mutex may be left.
  void take_over() { word_.store(kHeld, std::memory_order_relaxed); }

 private:
  static constexpr uint32_t kFree = 0, kHeld = 1, kAwaited = 2;
  std::atomic<uint32_t> word_{kFree};
};

class PlainCondition {
 public:
  static constexpr uint64_t kForever = UINT64_MAX;
  /// Returns after notify_all(), after `patience_ns`, or spuriously.
  void wait(std::unique_lock<PlainMutex>& lock, uint64_t patience_ns = kForever);
  /// wait() in two parts, for a caller that locks the mutex again in its own way.
  uint32_t turn() const { return turn_.load(std::memory_order_relaxed); }
  void wait_past(uint32_t turn, uint64_t patience_ns);
  void notify_all();

 private:
  std::atomic<uint32_t> turn_{0};
};

}  // namespace tilepress
