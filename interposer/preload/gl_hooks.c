// GL hooks: which stubs stand in front of what, and what happens when a stub has something to tell.
#include "gl_hooks.h"

#include <stddef.h>

#include "elf_symbols.h"
#include "entry_points.h"
#include "environment.h"
#include "gl_slots.h"
#include "plain_text.h"
#include "presenting.h"

#define HIDDEN __attribute__((visibility("hidden")))
#define THREAD_LOCAL HIDDEN __thread __attribute__((tls_model("initial-exec")))

struct tp_gl_slot {
  void* real;
  uint64_t kind;
};

// Read and, but for the names, entered by the stubs.
#define TP_GL_TRIGGER(name, kind) {NULL, TILEPRESS_GL_##kind},
#define TP_GL_TARGET(name, kind) {NULL, TILEPRESS_GL_##kind},
HIDDEN struct tp_gl_slot tp_gl_slots[TP_GL_NAMES + TP_GL_POOL] = {
#include "gl_names.def"
};
#undef TP_GL_TRIGGER
#undef TP_GL_TARGET

#define TP_GL_TRIGGER(name, kind) #name,
#define TP_GL_TARGET(name, kind) #name,
// Arrays, not pointers: readable before this library is relocated.
static const char kNames[][56] = {
#include "gl_names.def"
};
_Static_assert(sizeof kNames / sizeof *kNames == TP_GL_NAMES, "gl_slots.h tells another number of names");
_Static_assert(TP_GL_KIND_DRAW == TILEPRESS_GL_DRAW, "gl_slots.h tells another kind");

// A bit per kind; all of them until the first call asks the environment.
enum { kTriggers = 1 << TILEPRESS_GL_FINISH | 1 << TILEPRESS_GL_FLUSH | 1 << TILEPRESS_GL_READ_PIXELS };
HIDDEN uint32_t tp_gl_wanted = ~0u;
static uint32_t asked_for = ~0u;

// Where a draw call leaves its mark; in the engine, which the stubs of several libraries share.
THREAD_LOCAL uint8_t* tp_gl_drawn_at;
static uint8_t nowhere;

static __thread __attribute__((tls_model("initial-exec"))) void* osmesa;  // a function of its library
static __thread __attribute__((tls_model("initial-exec"))) bool osmesa_swaps;

// As the options of the same names: lists separated by commas.
static bool lists(const char* variable, const char* word) {
  const char* text = tp_environment(variable);
  const size_t length = tp_length(word);
  while (text != NULL && *text != 0) {
    if (tp_starts_with(text, word) && (text[length] == 0 || text[length] == ',')) return true;
    while (*text != 0 && *text != ',') ++text;
    if (*text == ',') ++text;
  }
  return false;
}

static uint32_t wanted(void) {
  uint32_t known = __atomic_load_n(&asked_for, __ATOMIC_ACQUIRE);
  if (known != ~0u) return known;
  known = 0;
  if (tp_environment("TILEPRESS_OUT") != NULL) {
    if (lists("TILEPRESS_TRIGGER", "finish")) known |= 1u << TILEPRESS_GL_FINISH;
    if (lists("TILEPRESS_TRIGGER", "flush")) known |= 1u << TILEPRESS_GL_FLUSH;
    if (lists("TILEPRESS_TRIGGER", "readpixels")) known |= 1u << TILEPRESS_GL_READ_PIXELS;
    if (lists("TILEPRESS_TARGETS", "all")) known |= ((1u << TILEPRESS_GL_KINDS) - 1) & ~(uint32_t)kTriggers;
  }
  __atomic_store_n(&asked_for, known, __ATOMIC_RELEASE);
  uint32_t unknown = ~0u;
  __atomic_compare_exchange_n(&tp_gl_wanted, &unknown, known, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE);
  return known;
}

int tp_find_gl(const char* name) {
  if (name == NULL || (!tp_starts_with(name, "gl") && tp_compare(name, "eglMakeCurrent") != 0)) return -1;
  for (int i = 0; i < TP_GL_NAMES; ++i)
    if (tp_compare(name, kNames[i]) == 0) return i;
  return -1;
}

bool tp_gl_concerns(int name) {
  const uint32_t kind = (uint32_t)tp_gl_slots[name].kind;
  return (1u << kind & (uint32_t)kTriggers) != 0 || (wanted() >> kind & 1) != 0;
}

extern HIDDEN char tp_gl_pool[];

void* tp_gl_answer(int name, void* real, bool always) {
  const uint64_t kind = tp_gl_slots[name].kind;
  if (real == NULL || !(always || (wanted() >> kind & 1) != 0)) return real;
  for (int slot = TP_GL_NAMES; slot < TP_GL_NAMES + TP_GL_POOL; ++slot) {
    struct tp_gl_slot* place = &tp_gl_slots[slot];
    void* held = __atomic_load_n(&place->real, __ATOMIC_ACQUIRE);
    if (held == NULL) {
      if (!__atomic_compare_exchange_n(&place->real, &held, real, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE))
        continue;
      tp_pin_library_of(real);
      // Nobody enters the stub before it is given out below, or by a later lookup that sees the kind.
      __atomic_store_n(&place->kind, kind, __ATOMIC_RELEASE);
      held = real;
    }
    if (held == real && __atomic_load_n(&place->kind, __ATOMIC_ACQUIRE) == kind)
      return tp_gl_pool + (slot - TP_GL_NAMES) * 16;
  }
  return real;
}

void tp_gl_making_current(uint32_t kind, const uintptr_t* arguments) {
  if ((wanted() >> kind & 1) == 0) return;
  struct TilepressGlCall call = {.kind = kind, .osmesa = osmesa, .arguments = arguments};
  tp_gl_called(&call);
}

void tp_gl_osmesa_current(void* real, bool swaps) {
  osmesa = real;
  osmesa_swaps = swaps;
  if (real == NULL) return;
  wanted();
  __atomic_fetch_or(&tp_gl_wanted, 1u << TILEPRESS_GL_FINISH | 1u << TILEPRESS_GL_FLUSH, __ATOMIC_RELAXED);
}

void* tp_gl_osmesa(void) {
  return osmesa;
}

// Called by the stubs only: for a slot without a real function, a thread without a place for its mark, and a
// call that is more than a mark. Returns the function to go on with, NULL if there is none.
HIDDEN void* tp_gl_before(struct tp_gl_slot* slot, const uintptr_t* arguments, void* caller);
HIDDEN void* tp_gl_before(struct tp_gl_slot* slot, const uintptr_t* arguments, void* caller) {
  void* real = __atomic_load_n(&slot->real, __ATOMIC_ACQUIRE);
  const uint32_t kind = (uint32_t)slot->kind;
  if (real == NULL) {
    real = tp_definition_after_ours(kNames[slot - tp_gl_slots], caller);
    if (real == NULL) return NULL;
    // A library whose own function of this name calls the same name beneath: each call is looked up.
    if (!tp_same_object(real, caller)) __atomic_store_n(&slot->real, real, __ATOMIC_RELEASE);
  }
  const bool trigger = (1u << kind & (uint32_t)kTriggers) != 0;
  const bool asked = (wanted() >> kind & 1) != 0;
  if (!asked && !(trigger && osmesa != NULL && !osmesa_swaps)) return real;
  if (tp_gl_drawn_at == NULL && !trigger) {
    tp_gl_drawn_at = tp_gl_drawn_mark();
    if (tp_gl_drawn_at == NULL) tp_gl_drawn_at = &nowhere;
  }
  if (kind == TILEPRESS_GL_DRAW) {
    *tp_gl_drawn_at = 1;
    return real;
  }
  struct TilepressGlCall call = {
      .kind = kind, .by_default = !asked, .osmesa = osmesa, .arguments = arguments};
  tp_gl_called(&call);
  return real;
}
