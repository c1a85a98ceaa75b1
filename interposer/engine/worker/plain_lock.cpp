// Plain lock: a futex mutex with three states, and a condition that counts its notifications.
#include "interposer/engine/worker/plain_lock.h"

#include <linux/futex.h>
#include <time.h>

#include <climits>

#include "interposer/system_calls.h"

namespace tilepress {
namespace {

void wait_while(const std::atomic<uint32_t>& word, uint32_t value, uint64_t patience_ns) {
  constexpr uint64_t kSecond = 1'000'000'000;
  const timespec limit = {static_cast<time_t>(patience_ns / kSecond),
                          static_cast<long>(patience_ns % kSecond)};
  system_call(SYS_futex, address_of(&word), FUTEX_WAIT_PRIVATE, value,
              patience_ns == PlainCondition::kForever ? 0 : address_of(&limit));
}

void wake(const std::atomic<uint32_t>& word, int count) {
  system_call(SYS_futex, address_of(&word), FUTEX_WAKE_PRIVATE, count);
}

}  // namespace

bool PlainMutex::try_lock() {
  uint32_t found = kFree;
  return word_.compare_exchange_strong(found, kHeld, std::memory_order_acquire);
}

void PlainMutex::lock() {
  if (try_lock()) return;
  while (word_.exchange(kAwaited, std::memory_order_acquire) != kFree)
    wait_while(word_, kAwaited, PlainCondition::kForever);
}

bool PlainMutex::try_lock_for(uint64_t patience_ns) {
  if (try_lock()) return true;
  const uint64_t end_ns = now_ns() + patience_ns;
  while (word_.exchange(kAwaited, std::memory_order_acquire) != kFree) {
    const uint64_t now = now_ns();
    if (now >= end_ns) return false;
    wait_while(word_, kAwaited, end_ns - now);
  }
  return true;
}

void PlainMutex::unlock() {
  if (word_.exchange(kFree, std::memory_order_release) == kAwaited) wake(word_, 1);
}

void PlainCondition::wait(std::unique_lock<PlainMutex>& lock, uint64_t patience_ns) {
  const uint32_t now = turn();
  lock.unlock();
  wait_past(now, patience_ns);
  lock.lock();
}

void PlainCondition::wait_past(uint32_t turn, uint64_t patience_ns) {
  wait_while(turn_, turn, patience_ns);
}

void PlainCondition::notify_all() {
  turn_.fetch_add(1, std::memory_order_relaxed);
  wake(turn_, INT_MAX);
}

}  // namespace tilepress
