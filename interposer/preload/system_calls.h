// System calls: made directly, because the C library's functions for them may be another library's. They leave
// errno alone; a result from -4095 to -1 is a negative errno.
#pragma once

#include <fcntl.h>
#include <limits.h>
#include <linux/futex.h>
#include <stddef.h>
#include <sys/syscall.h>

static inline long tp_system_call(long number, long a, long b, long c, long d) {
#if defined(__x86_64__)
  long result;
  register long r10 __asm__("r10") = d;
  __asm__ volatile("syscall"
                   : "=a"(result)
                   : "a"(number), "D"(a), "S"(b), "d"(c), "r"(r10)
                   : "rcx", "r11", "memory");
  return result;
#elif defined(__aarch64__)
  register long x8 __asm__("x8") = number;
  register long x0 __asm__("x0") = a;
  register long x1 __asm__("x1") = b;
  register long x2 __asm__("x2") = c;
  register long x3 __asm__("x3") = d;
  __asm__ volatile("svc 0" : "+r"(x0) : "r"(x8), "r"(x1), "r"(x2), "r"(x3) : "memory");
  return x0;
#else
#error "no system calls for this machine"
#endif
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
// Waits until another thread calls tp_wake; returns at once if *word is no longer `value`.
static inline void tp_wait_while(const int* word, int value) {
  tp_system_call(SYS_futex, (long)word, FUTEX_WAIT_PRIVATE, value, 0);
}
static inline void tp_wake(const int* word) {
  tp_system_call(SYS_futex, (long)word, FUTEX_WAKE_PRIVATE, INT_MAX, 0);
}
