// Entry points: looking names up, binding hooks, finding what an exported hook stands in front of.
#define _GNU_SOURCE
#include "entry_points.h"

#include <dlfcn.h>
#include <link.h>
#include <stddef.h>
#include <string.h>

#include "elf_symbols.h"
#include "real_dlsym.h"
#include "session_file.h"

// clang-format off
const char* const tp_entry_names[TP_ENTRY_COUNT] = {
    "eglDestroyContext",
    "eglDestroySurface",
    "eglGetProcAddress",
    "eglPostSubBufferNV",
    "eglSwapBuffers",
    "eglSwapBuffersWithDamageEXT",
    "eglSwapBuffersWithDamageKHR",
    "eglTerminate",
    "glXCopySubBufferMESA",
    "glXDestroyContext",
    "glXGetProcAddress",
    "glXGetProcAddressARB",
    "glXSwapBuffers",
    "glXSwapBuffersMscOML",
};
// clang-format on

void* tp_bound[TP_ENTRY_COUNT][TP_BANK_SIZE];

int tp_find_entry(const char* name) {
  // Nearly every name a program looks up is turned away by its first bytes.
  if (name == NULL || (name[0] != 'e' && name[0] != 'g')) return -1;
  if (name[1] != 'g' && name[1] != 'l') return -1;
  if (name[2] != 'l' && name[2] != 'X') return -1;
  int low = 0, high = TP_ENTRY_COUNT;
  while (low < high) {
    const int middle = (low + high) / 2;
    const int order = strcmp(name, tp_entry_names[middle]);
    if (order == 0) return middle;
    if (order < 0)
      high = middle;
    else
      low = middle + 1;
  }
  return -1;
}

// A bound function may be called at any later time, also after the program has closed the library that its
// pointer came from: the library stays.
static void pin_library_of(void* function) {
  Dl_info where;
  if (dladdr(function, &where) == 0 || where.dli_fname == NULL || strchr(where.dli_fname, '/') == NULL)
    return;
  dlopen(where.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
  dlerror();
}

void* tp_bind(enum tp_entry entry, void* real) {
  for (int slot = 0; slot < TP_BANK_SIZE; ++slot) {
    void* held = __atomic_load_n(&tp_bound[entry][slot], __ATOMIC_ACQUIRE);
    if (held == NULL && __atomic_compare_exchange_n(&tp_bound[entry][slot], &held, real, false,
                                                    __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE)) {
      pin_library_of(real);
      return tp_hooks[entry][slot];
    }
    if (held == real) return tp_hooks[entry][slot];
  }
  tp_session_note(tp_entry_names[entry], "unhooked");
  return real;
}

static void* find_definition(enum tp_entry entry, void* caller) {
  const char* name = tp_entry_names[entry];
  void* found = tp_real_dlsym()(RTLD_NEXT, name);
  if (found == NULL) {
    // Not in the global scope: the caller's own library may have brought its GL library along.
    Dl_info where;
    struct link_map* object = NULL;
    if (dladdr1(caller, &where, (void**)&object, RTLD_DL_LINKMAP) != 0 && object != NULL)
      found = tp_real_dlsym()(object, name);
    if (found != NULL && tp_is_ours(found)) found = NULL;
  }
  dlerror();
  for (int slot = 0; found == NULL && slot < TP_BANK_SIZE; ++slot)
    found = __atomic_load_n(&tp_bound[entry][slot], __ATOMIC_ACQUIRE);
  if (found == NULL) found = tp_symbol_anywhere(name, NULL);
  return found;
}

void* tp_next_definition(enum tp_entry entry, void* caller) {
  static void* known[TP_ENTRY_COUNT];
  void* found = __atomic_load_n(&known[entry], __ATOMIC_ACQUIRE);
  if (found == NULL) {
    found = find_definition(entry, caller);
    if (found == NULL) return NULL;
    pin_library_of(found);
    __atomic_store_n(&known[entry], found, __ATOMIC_RELEASE);
  }
  // A library that implements its entry point by calling the same name in the library beneath it.
  if (tp_same_object(found, caller)) return tp_symbol_anywhere(tp_entry_names[entry], found);
  return found;
}

void* tp_answer_get_proc_address(const char* name, void* real, void* get_proc_address) {
  const int entry = real != NULL ? tp_find_entry(name) : -1;
  if (entry < 0) return real;
  if (tp_is_ours(real)) {
    // The library asked the dynamic linker for its own function and was given ours.
    real = tp_symbol_in_object_of(get_proc_address, name);
    if (real == NULL) return NULL;
  }
  tp_session_note(name, "getprocaddress");
  return tp_bind((enum tp_entry)entry, real);
}
