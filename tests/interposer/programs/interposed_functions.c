/* interposed_functions: defines functions of the C library that must not be called while a symbol is looked up, as
   in a sanitizer that is not ready. Linked into a program, -Wl,--wrap marks its lookups. Preloaded, nothing is
   marked, because constructors of the program's libraries call them. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

static __thread int looking_up;

static void refuse_in_lookup(void) {
  if (looking_up) __builtin_trap();
}

#ifdef MARKED
void* __real_dlsym(void* handle, const char* name);
void* __real_dlvsym(void* handle, const char* name, const char* version);
void* __wrap_dlsym(void* handle, const char* name);
void* __wrap_dlvsym(void* handle, const char* name, const char* version);

void* __wrap_dlsym(void* handle, const char* name) {
  ++looking_up;
  void* found = __real_dlsym(handle, name);
  --looking_up;
  return found;
}
void* __wrap_dlvsym(void* handle, const char* name, const char* version) {
  ++looking_up;
  void* found = __real_dlvsym(handle, name, version);
  --looking_up;
  return found;
}
#endif

/* A volatile read keeps the compiler from calling the function defined here. */
#define BYTE(pointer) (*(const volatile unsigned char*)(pointer))

size_t strlen(const char* text) {
  refuse_in_lookup();
  size_t length = 0;
  while (BYTE(text + length) != 0) ++length;
  return length;
}
int strcmp(const char* a, const char* b) {
  refuse_in_lookup();
  while (BYTE(a) != 0 && BYTE(a) == BYTE(b)) ++a, ++b;
  return BYTE(a) - BYTE(b);
}
int strncmp(const char* a, const char* b, size_t count) {
  refuse_in_lookup();
  for (; count > 0; --count, ++a, ++b)
    if (BYTE(a) != BYTE(b) || BYTE(a) == 0) return BYTE(a) - BYTE(b);
  return 0;
}
char* strchr(const char* text, int wanted) {
  refuse_in_lookup();
  for (;; ++text) {
    if (BYTE(text) == (unsigned char)wanted) return (char*)(uintptr_t)text;
    if (BYTE(text) == 0) return NULL;
  }
}
char* strrchr(const char* text, int wanted) {
  refuse_in_lookup();
  const char* found = NULL;
  for (;; ++text) {
    if (BYTE(text) == (unsigned char)wanted) found = text;
    if (BYTE(text) == 0) return (char*)(uintptr_t)found;
  }
}
char* strstr(const char* text, const char* part) {
  const size_t length = strlen(part);
  for (;; ++text) {
    if (strncmp(text, part, length) == 0) return (char*)(uintptr_t)text;
    if (BYTE(text) == 0) return NULL;
  }
}
void* memcpy(void* restrict to, const void* restrict from, size_t count) {
  refuse_in_lookup();
  for (size_t i = 0; i < count; ++i) ((volatile char*)to)[i] = ((const char*)from)[i];
  return to;
}
void* memset(void* to, int value, size_t count) {
  refuse_in_lookup();
  for (size_t i = 0; i < count; ++i) ((volatile char*)to)[i] = (char)value;
  return to;
}
int memcmp(const void* a, const void* b, size_t count) {
  refuse_in_lookup();
  for (size_t i = 0; i < count; ++i) {
    const int difference = BYTE((const char*)a + i) - BYTE((const char*)b + i);
    if (difference != 0) return difference;
  }
  return 0;
}

/* Like a sandbox: no variable is set. */
char* getenv(const char* name) {
  refuse_in_lookup();
  (void)name;
  return NULL;
}
int dl_iterate_phdr(int (*callback)(struct dl_phdr_info*, size_t, void*), void* data) {
  refuse_in_lookup();
  (void)callback, (void)data;
  return 0;
}
int dladdr(const void* address, Dl_info* info) {
  refuse_in_lookup();
  (void)address, (void)info;
  return 0;
}
int dladdr1(const void* address, Dl_info* info, void** extra, int flags) {
  refuse_in_lookup();
  (void)address, (void)info, (void)extra, (void)flags;
  return 0;
}
int open(const char* path, int flags, ...) {
  refuse_in_lookup();
  va_list arguments;
  va_start(arguments, flags);
  const int mode = va_arg(arguments, int);
  va_end(arguments);
  return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}
ssize_t write(int file, const void* bytes, size_t count) {
  refuse_in_lookup();
  return syscall(SYS_write, file, bytes, count);
}
int close(int file) {
  refuse_in_lookup();
  return (int)syscall(SYS_close, file);
}
pid_t getpid(void) {
  refuse_in_lookup();
  return (pid_t)syscall(SYS_getpid);
}

/* Like a profiler's allocator: the first call finds the allocator beneath. */
static void* next(const char* name) {
  return dlsym(RTLD_NEXT, name);
}
void* malloc(size_t size) {
  static void* (*beneath)(size_t);
  if (beneath == NULL) *(void**)&beneath = next("malloc");
  return beneath(size);
}
void free(void* block) {
  static void (*beneath)(void*);
  if (beneath == NULL) *(void**)&beneath = next("free");
  beneath(block);
}
