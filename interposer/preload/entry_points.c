// Entry points: looking names up, binding hooks, finding what an exported hook stands in front of.
#define _GNU_SOURCE
#include "entry_points.h"

#include <dlfcn.h>
#include <link.h>
#include <stddef.h>

#include "c_library.h"
#include "elf_symbols.h"
#include "gl_hooks.h"
#include "plain_text.h"
#include "session_file.h"

// Arrays, not pointers: readable before this library is relocated.
// clang-format off
const char tp_entry_names[TP_ENTRY_COUNT][TP_ENTRY_NAME_SIZE] = {
    "OSMesaDestroyContext",
    "OSMesaGetProcAddress",
    "OSMesaMakeCurrent",
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
    "glXMakeContextCurrent",
    "glXMakeCurrent",
    "glXSwapBuffers",
    "glXSwapBuffersMscOML",
    "glfwSwapBuffers",
};
// clang-format on

void* tp_bound[TP_ENTRY_COUNT][TP_BANK_SIZE];

int tp_find_entry(const char* name) {
  // Nearly every name a program looks up is turned away by its first bytes.
  if (name == NULL || (name[0] != 'e' && name[0] != 'g' && name[0] != 'O')) return -1;
  if (name[1] != 'g' && name[1] != 'l' && name[1] != 'S') return -1;
  if (name[2] != 'l' && name[2] != 'X' && name[2] != 'f' && name[2] != 'M') return -1;
  int low = 0, high = TP_ENTRY_COUNT;
  while (low < high) {
    const int middle = (low + high) / 2;
    const int order = tp_compare(name, tp_entry_names[middle]);
    if (order == 0) return middle;
    if (order < 0)
      high = middle;
    else
      low = middle + 1;
  }
  return -1;
}

void tp_pin_library_of(void* function) {
  char path[4096];
  if (!tp_path_of_object(function, path, sizeof path) || tp_base_name(path) == path) return;
  tp_c_library()->dlopen(path, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
  tp_c_library()->dlerror();
}

void* tp_bind(enum tp_entry entry, void* real) {
  for (int slot = 0; slot < TP_BANK_SIZE; ++slot) {
    void* held = __atomic_load_n(&tp_bound[entry][slot], __ATOMIC_ACQUIRE);
    if (held == NULL && __atomic_compare_exchange_n(&tp_bound[entry][slot], &held, real, false,
                                                    __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE)) {
      tp_pin_library_of(real);
      return tp_hooks[entry][slot];
    }
    if (held == real) return tp_hooks[entry][slot];
  }
  tp_session_note(tp_entry_names[entry], "unhooked");
  return real;
}

static void* next_or_the_callers(const char* name, void* caller) {
  const struct tp_c_library* library = tp_c_library();
  if (library == NULL) return NULL;
  void* found = library->dlsym(RTLD_NEXT, name);
  if (found == NULL) {
    // Not in the global scope: the caller's own library may have brought its GL library along.
    void* object = tp_handle_of_object(caller);
    if (object != NULL) found = library->dlsym(object, name);
    if (found != NULL && tp_is_ours(found)) found = NULL;
  }
  library->dlerror();
  return found;
}

static void* find_definition(enum tp_entry entry, void* caller) {
  void* found = next_or_the_callers(tp_entry_names[entry], caller);
  for (int slot = 0; found == NULL && slot < TP_BANK_SIZE; ++slot)
    found = __atomic_load_n(&tp_bound[entry][slot], __ATOMIC_ACQUIRE);
  if (found == NULL) found = tp_symbol_anywhere(tp_entry_names[entry], NULL);
  return found;
}

void* tp_definition_after_ours(const char* name, void* caller) {
  void* found = next_or_the_callers(name, caller);
  if (found == NULL) found = tp_symbol_anywhere(name, NULL);
  if (found != NULL && tp_same_object(found, caller)) return tp_symbol_anywhere(name, found);
  if (found != NULL) tp_pin_library_of(found);
  return found;
}

void* tp_next_definition(enum tp_entry entry, void* caller) {
  static void* known[TP_ENTRY_COUNT];
  void* found = __atomic_load_n(&known[entry], __ATOMIC_ACQUIRE);
  if (found == NULL) {
    found = find_definition(entry, caller);
    if (found == NULL) return NULL;
    tp_pin_library_of(found);
    __atomic_store_n(&known[entry], found, __ATOMIC_RELEASE);
  }
  // A library that implements its entry point by calling the same name in the library beneath it.
  if (tp_same_object(found, caller)) return tp_symbol_anywhere(tp_entry_names[entry], found);
  return found;
}

void* tp_answer_get_proc_address(const char* name, void* real, void* get_proc_address) {
  const int entry = real != NULL ? tp_find_entry(name) : -1;
  const int gl = real != NULL && entry < 0 ? tp_find_gl(name) : -1;
  if (entry < 0 && gl < 0) return real;
  if (tp_is_ours(real)) {
    // The library asked the dynamic linker for its own function and was given ours.
    real = tp_symbol_in_object_of(get_proc_address, name);
    if (real == NULL) return NULL;
  }
  if (gl >= 0) return tp_gl_answer(gl, real, false);
  tp_session_note(name, "getprocaddress");
  return tp_bind((enum tp_entry)entry, real);
}
