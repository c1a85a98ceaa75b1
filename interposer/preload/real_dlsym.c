// The real dlsym: read from the C library's symbol table, so that no lookup has to pass through our own
// dlsym.
#include "real_dlsym.h"

#include <stddef.h>

#include "elf_symbols.h"

// glibc before 2.34 has dlsym in libdl, later in libc; musl names its library after the machine.
static void* find(const char* name) {
  static const char* const kLibraries[] = {"libdl.so", "libc.so", "libc.musl", "ld-musl", NULL};
  return tp_symbol_in_library(kLibraries, name);
}

tp_dlsym_function tp_real_dlsym(void) {
  static void* known;
  void* found = __atomic_load_n(&known, __ATOMIC_ACQUIRE);
  if (found == NULL) {
    found = find("dlsym");
    __atomic_store_n(&known, found, __ATOMIC_RELEASE);
  }
  return (tp_dlsym_function)found;
}

tp_dlvsym_function tp_real_dlvsym(void) {
  static void* known;
  void* found = __atomic_load_n(&known, __ATOMIC_ACQUIRE);
  if (found == NULL) {
    found = find("dlvsym");
    __atomic_store_n(&known, found, __ATOMIC_RELEASE);
  }
  return (tp_dlvsym_function)found;
}
