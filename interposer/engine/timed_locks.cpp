// Timed locks: the C++ library's locks with a time limit call pthread_mutex_clocklock, which the thread sanitizer
// does not know. In a program that was built with the sanitizer it would report the unlock. This definition,
// hidden in the engine, calls pthread_mutex_timedlock instead, which the sanitizer knows.
#include <pthread.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

namespace {

constexpr long kSecondNs = 1'000'000'000;

}  // namespace

extern "C" int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                       const timespec* until) noexcept {
  timespec here{}, there{};
  clock_gettime(clock, &here);  // as the caller's, which faketime may have moved
  syscall(SYS_clock_gettime, CLOCK_REALTIME, &there);
  timespec end{there.tv_sec + until->tv_sec - here.tv_sec, there.tv_nsec + until->tv_nsec - here.tv_nsec};
  for (; end.tv_nsec < 0; end.tv_nsec += kSecondNs) --end.tv_sec;
  for (; end.tv_nsec >= kSecondNs; end.tv_nsec -= kSecondNs) ++end.tv_sec;
  return pthread_mutex_timedlock(mutex, &end);
}
