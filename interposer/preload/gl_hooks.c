// GL hooks: binds the stubs of the pool to real functions.
#include "gl_hooks.h"

#include <stddef.h>

#include "definitions.h"
#include "gl_calls.h"
#include "plain_text.h"

// Stubs of 16 bytes each. The first belongs to the slot TP_GL_NAMES.
extern __attribute__((visibility("hidden"))) char tp_gl_pool[];

int tp_find_gl(const char* name) {
  if (name == NULL || (!tp_starts_with(name, "gl") && tp_compare(name, "eglMakeCurrent") != 0)) return -1;
  for (int i = 0; i < TP_GL_NAMES; ++i)
    if (tp_compare(name, tp_gl_names[i]) == 0) return i;
  return -1;
}

bool tp_gl_concerns(int name) {
  const uint64_t kind = tp_gl_slots[name].kind;
  return tp_gl_is_trigger(kind) || tp_gl_is_wanted(kind);
}

void* tp_gl_answer(int name, void* real, bool always) {
  const uint64_t kind = tp_gl_slots[name].kind;
  if (real == NULL || !(always || tp_gl_is_wanted(kind))) return real;
  for (int number = 0; number < TP_GL_POOL; ++number) {
    struct tp_gl_slot* slot = &tp_gl_slots[TP_GL_NAMES + number];
    void* held = __atomic_load_n(&slot->real, __ATOMIC_ACQUIRE);
    if (held == NULL) {
      if (!__atomic_compare_exchange_n(&slot->real, &held, real, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE))
        continue;
      tp_pin_library_of(real);
      // No thread enters the stub before this function returns it, here or to a later lookup that sees the
      // kind.
      __atomic_store_n(&slot->kind, kind, __ATOMIC_RELEASE);
      held = real;
    }
    if (held == real && __atomic_load_n(&slot->kind, __ATOMIC_ACQUIRE) == kind)
      return tp_gl_pool + number * 16;
  }
  return real;
}
