// System calls, made directly: the C library's functions for them may be replaced by another library's. For C
// (the preloaded libraries) and C++ (engine and tools). A result from -4095 to -1 is a negative errno; errno
// itself stays.
#pragma once

#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/syscall.h>
#include <time.h>

static inline long tp_call_kernel(long number, long a, long b, long c, long d, long e, long f) {
#if defined(__x86_64__)
  long result;
  register long r10 __asm__("r10") = d;
  register long r8 __asm__("r8") = e;
  register long r9 __asm__("r9") = f;
  __asm__ volatile("syscall"
                   : "=a"(result)
                   : "a"(number), "D"(a), "S"(b), "d"(c), "r"(r10), "r"(r8), "r"(r9)
                   : "rcx", "r11", "memory");
  return result;
#elif defined(__aarch64__)
  register long x8 __asm__("x8") = number;
  register long x0 __asm__("x0") = a;
  register long x1 __asm__("x1") = b;
  register long x2 __asm__("x2") = c;
  register long x3 __asm__("x3") = d;
  register long x4 __asm__("x4") = e;
  register long x5 __asm__("x5") = f;
  __asm__ volatile("svc 0" : "+r"(x0) : "r"(x8), "r"(x1), "r"(x2), "r"(x3), "r"(x4), "r"(x5) : "memory");
  return x0;
#else
#error "tilepress: system calls are written for x86-64 and AArch64 only"
#endif
}

#ifdef __cplusplus
namespace tilepress {

inline long system_call(long number, long a = 0, long b = 0, long c = 0, long d = 0, long e = 0, long f = 0) {
  return tp_call_kernel(number, a, b, c, d, e, f);
}

inline long address_of(const volatile void* memory) {
  return reinterpret_cast<long>(memory);
}

/// Nanoseconds of the kernel's clock. Some programs run on an invented time and replace the C library's
/// function.
inline uint64_t clock_ns(clockid_t clock) {
  timespec now{};
  system_call(SYS_clock_gettime, clock, address_of(&now));
  return static_cast<uint64_t>(now.tv_sec) * 1000000000u + static_cast<uint64_t>(now.tv_nsec);
}

/// Nanoseconds that never run backwards.
inline uint64_t now_ns() {
  return clock_ns(CLOCK_MONOTONIC);
}

}  // namespace tilepress
#else
static inline long tp_system_call(long number, long a, long b, long c, long d) {
  return tp_call_kernel(number, a, b, c, d, 0, 0);
}
static inline int tp_open(const char* path, int flags, int mode) {
  return (int)tp_system_call(SYS_openat, AT_FDCWD, (long)path, flags | O_CLOEXEC, mode);
}
static inline long tp_read(int file, void* bytes, size_t count) {
  return tp_system_call(SYS_read, file, (long)bytes, (long)count, 0);
}
static inline long tp_write(int file, const void* bytes, size_t count) {
  return tp_system_call(SYS_write, file, (long)bytes, (long)count, 0);
}
static inline void tp_close(int file) {
  tp_system_call(SYS_close, file, 0, 0, 0);
}
static inline int tp_process_id(void) {
  return (int)tp_system_call(SYS_getpid, 0, 0, 0, 0);
}
// Waits until another thread calls tp_wake. Returns at once if *word is no longer `value`.
static inline void tp_wait_while(const int* word, int value) {
  tp_system_call(SYS_futex, (long)word, FUTEX_WAIT_PRIVATE, value, 0);
}
static inline void tp_wake(const int* word) {
  tp_system_call(SYS_futex, (long)word, FUTEX_WAKE_PRIVATE, INT_MAX, 0);
}
#endif
