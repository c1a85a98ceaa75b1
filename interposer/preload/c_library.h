// C library: its functions that the shim calls, found in its symbol table. The shim does not call them by
// name, because a sanitizer, a shell or the program may define functions of these names. A sanitizer's
// functions are not ready for calls while it looks symbols up.
#pragma once

#include <stdbool.h>
#include <stddef.h>

typedef void* (*tp_dlsym_function)(void* handle, const char* name);
typedef void* (*tp_dlvsym_function)(void* handle, const char* name, const char* version);

struct dl_phdr_info;

struct tp_c_library {
  bool is_glibc;  // the engine needs glibc
  tp_dlsym_function dlsym;
  tp_dlvsym_function dlvsym;  // NULL in musl
  // What a call would reach without this library: another interposer's function, or the two above.
  tp_dlsym_function next_dlsym;
  tp_dlvsym_function next_dlvsym;
  void* (*dlopen)(const char* file, int flags);
  char* (*dlerror)(void);
  int (*dladdr1)(const void* address, void* where, void** extra, int flags);  // NULL in musl
  int (*dl_iterate_phdr)(int (*visit)(struct dl_phdr_info*, size_t, void*), void* argument);
  int (*pthread_setcancelstate)(int state, int* before);
  int* (*errno_location)(void);
};

// Returns NULL only if the C library cannot be found. Allocates nothing and takes no lock.
const struct tp_c_library* tp_c_library(void);

// Returns the function that a call of `name` would reach if this library did not define it: the first behind
// this library in load order, among the objects that the program started with. Looks it up each time.
void* tp_function_behind_ours(const char* name);
