// Timed locks as the thread sanitizer of GCC 12 knows them: it does not see pthread_mutex_clocklock, which
// locks of the C++ library with a time limit are made of, and takes what they guard for unguarded.
#include <pthread.h>
#include <time.h>

namespace {

constexpr long kSecondNs = 1'000'000'000;

timespec now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return time;
}

}  // namespace

extern "C" int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                       const timespec* until) noexcept {
  const timespec here = now(clock), there = now(CLOCK_REALTIME);
  timespec end{there.tv_sec + until->tv_sec - here.tv_sec, there.tv_nsec + until->tv_nsec - here.tv_nsec};
  for (; end.tv_nsec < 0; end.tv_nsec += kSecondNs) --end.tv_sec;
  for (; end.tv_nsec >= kSecondNs; end.tv_nsec -= kSecondNs) ++end.tv_sec;
  return pthread_mutex_timedlock(mutex, &end);
}
