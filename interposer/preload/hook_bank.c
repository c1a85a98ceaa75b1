// Hook bank: for every entry point, hooks that each know their real function, and the exported function that
// linked programs call.
#include "hook_bank.h"

#include <stddef.h>

#include "definitions.h"
#include "elf_symbols.h"
#include "gl_hooks.h"
#include "hooks.h"
#include "session_file.h"

enum { kBankSize = 8 };  // hooks of an entry point
// clang-format off
#define EACH_SLOT(DO, ...)                                                    \
  DO(0, __VA_ARGS__) DO(1, __VA_ARGS__) DO(2, __VA_ARGS__) DO(3, __VA_ARGS__) \
  DO(4, __VA_ARGS__) DO(5, __VA_ARGS__) DO(6, __VA_ARGS__) DO(7, __VA_ARGS__)
// clang-format on

static void* real_functions[TP_ENTRY_COUNT][kBankSize];  // filled from the front, never emptied

static void* real_function(enum tp_entry entry, int slot) {
  return __atomic_load_n(&real_functions[entry][slot], __ATOMIC_ACQUIRE);
}

// What a call of our export reaches. Looked up at the first call.
static void* linked_function(enum tp_entry entry, void* caller) {
  static void* known[TP_ENTRY_COUNT];
  const char* const name = tp_entry_names[entry];
  tp_session_note(entry, TP_WAY_LINK);
  void* found = __atomic_load_n(&known[entry], __ATOMIC_ACQUIRE);
  if (found == NULL) {
    found = tp_definition_after_ours(name, caller, real_function(entry, 0));
    if (found == NULL) return NULL;
    __atomic_store_n(&known[entry], found, __ATOMIC_RELEASE);
  }
  return tp_beneath_caller(name, found, caller);
}

static void* on_get_proc_address(void* real, const char* name);

#define HOOK(slot, name, result, hook, parameters, ...)             \
  static result name##_##slot parameters {                          \
    return hook(real_function(TP_ENTRY_##name, slot), __VA_ARGS__); \
  }
#define TP_ENTRY(name, kind, result, hook, parameters, ...)                           \
  __attribute__((visibility("default"))) result name parameters;                      \
  __attribute__((visibility("default"))) result name parameters {                     \
    void* const real = linked_function(TP_ENTRY_##name, __builtin_return_address(0)); \
    return real != NULL ? hook(real, __VA_ARGS__) : (result)0;                        \
  }                                                                                   \
  EACH_SLOT(HOOK, name, result, hook, parameters, __VA_ARGS__)
#include "entry_points.def"

static void* const hooks[TP_ENTRY_COUNT][kBankSize] = {
#define POINTER(slot, name) name##_##slot,
#define TP_ENTRY(name, ...) {EACH_SLOT(POINTER, name)},
#include "entry_points.def"
};
#define ONE(slot, unused) +1
_Static_assert(EACH_SLOT(ONE, ) == kBankSize, "EACH_SLOT and kBankSize differ");

void* tp_bind(enum tp_entry entry, void* real) {
  for (int slot = 0; slot < kBankSize; ++slot) {
    void* held = real_function(entry, slot);
    if (held == NULL && __atomic_compare_exchange_n(&real_functions[entry][slot], &held, real, false,
                                                    __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE)) {
      tp_pin_library_of(real);
      return hooks[entry][slot];
    }
    if (held == real) return hooks[entry][slot];
  }
  tp_session_note(entry, TP_WAY_UNHOOKED);
  return real;
}

static void* on_get_proc_address(void* real, const char* name) {
  void* answer = ((void* (*)(const char*))real)(name);
  if (answer == NULL) return NULL;
  const int entry = tp_find_entry(name), gl = entry < 0 ? tp_find_gl(name) : -1;
  if (entry < 0 && gl < 0) return answer;
  if (tp_is_ours(answer)) {
    // The library asked the dynamic linker for its own function and got ours.
    answer = tp_symbol_in_object_of(real, name);
    if (answer == NULL) return NULL;
  }
  if (gl >= 0) return tp_gl_answer(gl, answer, false);
  tp_session_note((enum tp_entry)entry, TP_WAY_GET_PROC_ADDRESS);
  return tp_bind((enum tp_entry)entry, answer);
}

void* tp_answer_vendor(const char* name, void* real) {
  if (real == NULL) return NULL;
  const int entry = tp_find_entry(name), gl = entry < 0 ? tp_find_gl(name) : -1;
  if (gl >= 0) return tp_gl_answer(gl, real, false);
  // libglvnd answers lookups itself: those of the driver stay as they are.
  return entry >= 0 && tp_entry_kinds[entry] != TP_LOOKS_UP ? tp_bind((enum tp_entry)entry, real) : real;
}
