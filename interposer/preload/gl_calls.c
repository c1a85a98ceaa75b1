// GL calls: the slots that the stubs read, and what a stub leaves to C.
#include "gl_calls.h"

#include <stddef.h>

#include "definitions.h"
#include "environment.h"
#include "plain_text.h"
#include "presenting.h"

#define THREAD_LOCAL __thread __attribute__((tls_model("initial-exec")))

struct tp_gl_slot tp_gl_slots[TP_GL_NAMES + TP_GL_POOL] = {
#define TP_GL_TRIGGER(name, kind) {NULL, TILEPRESS_GL_##kind},
#define TP_GL_TARGET(name, kind) {NULL, TILEPRESS_GL_##kind},
#include "gl_names.def"
};

const char tp_gl_names[TP_GL_NAMES][TP_GL_NAME_SIZE] = {
#define TP_GL_TRIGGER(name, kind) #name,
#define TP_GL_TARGET(name, kind) #name,
#include "gl_names.def"
};

_Static_assert(TP_GL_KIND_DRAW == TILEPRESS_GL_DRAW, "the stubs know another number");

// A bit per kind. The stubs read the first; it has all bits until the first call reads the environment.
uint32_t tp_gl_wanted = ~0u;
static uint32_t asked_for = ~0u;
enum { kTriggers = 1 << TILEPRESS_GL_FINISH | 1 << TILEPRESS_GL_FLUSH | 1 << TILEPRESS_GL_READ_PIXELS };

// Where the thread's draw calls leave their mark. The engine owns the byte: the stubs of several libraries
// share it.
THREAD_LOCAL uint8_t* tp_gl_drawn_at;
static uint8_t nowhere;

static THREAD_LOCAL void* osmesa;  // a function of its library
static THREAD_LOCAL bool osmesa_swaps;

// Returns true if the variable, a list separated by commas, contains `word`.
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

static uint32_t read_environment(void) {
  uint32_t kinds = 0;
  if (tp_environment("TILEPRESS_OUT") == NULL) return kinds;
  if (lists("TILEPRESS_TRIGGER", "finish")) kinds |= 1u << TILEPRESS_GL_FINISH;
  if (lists("TILEPRESS_TRIGGER", "flush")) kinds |= 1u << TILEPRESS_GL_FLUSH;
  if (lists("TILEPRESS_TRIGGER", "readpixels")) kinds |= 1u << TILEPRESS_GL_READ_PIXELS;
  if (lists("TILEPRESS_TARGETS", "all")) kinds |= ((1u << TILEPRESS_GL_KINDS) - 1) & ~(uint32_t)kTriggers;
  return kinds;
}

static uint32_t wanted_kinds(void) {
  uint32_t known = __atomic_load_n(&asked_for, __ATOMIC_ACQUIRE);
  if (known != ~0u) return known;
  known = read_environment();
  __atomic_store_n(&asked_for, known, __ATOMIC_RELEASE);
  uint32_t unknown = ~0u;
  __atomic_compare_exchange_n(&tp_gl_wanted, &unknown, known, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE);
  return known;
}

bool tp_gl_is_wanted(uint64_t kind) {
  return (wanted_kinds() >> kind & 1) != 0;
}

bool tp_gl_is_trigger(uint64_t kind) {
  return (1u << kind & (uint32_t)kTriggers) != 0;
}

void tp_gl_making_current(uint32_t kind, const uintptr_t* arguments) {
  if (!tp_gl_is_wanted(kind)) return;
  struct TilepressGlCall call = {.kind = kind, .osmesa = osmesa, .arguments = arguments};
  tp_gl_called(&call);
}

void tp_gl_osmesa_current(void* real, bool swaps) {
  osmesa = real;
  osmesa_swaps = swaps;
  if (real == NULL) return;
  wanted_kinds();
  __atomic_fetch_or(&tp_gl_wanted, 1u << TILEPRESS_GL_FINISH | 1u << TILEPRESS_GL_FLUSH, __ATOMIC_RELAXED);
}

void* tp_gl_osmesa(void) {
  return osmesa;
}

// The stubs call this in three cases: the slot has no real function, the thread has no place for its mark, or
// the call is more than a mark. Returns the function to go on with; NULL if no library defines it.
void* tp_gl_before(struct tp_gl_slot* slot, const uintptr_t* arguments, void* caller) {
  void* real = __atomic_load_n(&slot->real, __ATOMIC_ACQUIRE);
  const uint32_t kind = (uint32_t)slot->kind;
  if (real == NULL) {
    const char* const name = tp_gl_names[slot - tp_gl_slots];
    real = tp_definition_after_ours(name, caller, NULL);
    if (real != NULL) real = tp_beneath_caller(name, real, caller);
    if (real == NULL) return NULL;
    __atomic_store_n(&slot->real, real, __ATOMIC_RELEASE);
  }
  const bool trigger = tp_gl_is_trigger(kind), asked = tp_gl_is_wanted(kind);
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
