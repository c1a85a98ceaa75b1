// Symbol filter: decides what each dlsym and dlvsym of the process returns.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdbool.h>
#include <stddef.h>

#include "c_library.h"
#include "elf_symbols.h"
#include "gl_hooks.h"
#include "hook_bank.h"
#include "plain_text.h"
#include "session_file.h"

// What the trampoline does next: it jumps to `jump_to` with its caller's stack and registers, or returns
// `answer` if `jump_to` is NULL. Both machines pass this struct in two registers.
struct tp_verdict {
  void* jump_to;
  void* answer;
};

// RTLD_NEXT is relative to the caller, so the C library answers it. For other handles another interposer may
// answer.
static void* look_up(void* handle, const char* name, const char* version) {
  const struct tp_c_library* library = tp_c_library();
  const bool next = handle == RTLD_NEXT;
  if (version != NULL) return (next ? library->dlvsym : library->next_dlvsym)(handle, name, version);
  return (next ? library->dlsym : library->next_dlsym)(handle, name);
}

// ANGLE's functions stay as they are: the shim sees ANGLE's frames at the GL library beneath.
static bool is_angle(const void* function) {
  return tp_symbol_in_object_of(function, "eglStreamPostD3DTextureANGLE") != NULL ||
         tp_symbol_in_object_of(function, "ANGLEGetDisplayPlatform") != NULL;  // its libGLESv2
}

// RTLD_NEXT finds our export only if the caller stands before us in load order.
static bool next_is_ours(const void* caller) {
  const int position = tp_load_position(caller);
  return position >= 0 && position < tp_load_position((const void*)&next_is_ours);
}

// The lookup found our own export. Returns what it would have found without the shim.
static void* look_past_us(void* handle, const char* name, const char* version, const void* caller) {
  void* found = look_up(RTLD_NEXT, name, version);
  if (found != NULL || handle != RTLD_DEFAULT) return found;
  // The caller may be a plugin with libraries of its own, which are not in the global scope.
  void* object = tp_handle_of_object(caller);
  if (object != NULL) found = look_up(object, name, version);
  if (found != NULL && !tp_is_ours(found)) {
    tp_c_library()->dlerror();  // a successful lookup leaves no message
    return found;
  }
  return look_up(RTLD_NEXT, name, version);  // finds nothing and sets dlerror
}

// A program with its own dlsym finds the next one with dlvsym, because the C library's has a version. Ours
// has none, so the lookup skips it. Returns ours if the lookup finds what ours forwards to, else NULL.
static void* own_lookup(void* handle, const char* name, const char* version, const void* caller) {
  if (version == NULL || handle != RTLD_NEXT || name == NULL || !tp_starts_with(name, "dl")) return NULL;
  const bool plain = tp_compare(name, "dlsym") == 0;
  if ((!plain && tp_compare(name, "dlvsym") != 0) || !next_is_ours(caller)) return NULL;
  const struct tp_c_library* library = tp_c_library();
  void* const beneath = plain ? (void*)library->next_dlsym : (void*)library->next_dlvsym;
  if (library->dlvsym(handle, name, version) != beneath) return NULL;
  return tp_symbol_in_object_of((const void*)&own_lookup, name);
}

static struct tp_verdict decide(void* handle, const char* name, const char* version, const void* caller,
                                void* real_function) {
  const struct tp_verdict forward = {real_function, NULL};
  if (real_function == NULL) return forward;
  void* const own = own_lookup(handle, name, version, caller);
  if (own != NULL) return (struct tp_verdict){NULL, own};
  const int entry = tp_find_entry(name), gl = entry < 0 ? tp_find_gl(name) : -1;
  if (entry < 0 && (gl < 0 || !tp_gl_concerns(gl))) return forward;
  void* real;
  if (handle == RTLD_NEXT) {
    if (!next_is_ours(caller)) return forward;
    real = look_past_us(handle, name, version, caller);
  } else {
    real = look_up(handle, name, version);
    if (real == NULL) return forward;  // the real function fails once more and sets dlerror
    if (tp_is_ours(real)) real = look_past_us(handle, name, version, caller);
  }
  if (real == NULL) return (struct tp_verdict){NULL, NULL};
  if (is_angle(real)) return (struct tp_verdict){NULL, real};
  if (gl >= 0) {
    const bool osmesa = tp_symbol_in_object_of(real, "OSMesaMakeCurrent") != NULL;
    return (struct tp_verdict){NULL, tp_gl_answer(gl, real, osmesa)};
  }
  tp_session_note((enum tp_entry)entry, TP_WAY_DLSYM);
  return (struct tp_verdict){NULL, tp_bind((enum tp_entry)entry, real)};
}

// The trampolines call these two.
struct tp_verdict tp_filter_dlsym(void* handle, const char* name, const void* caller) {
  const struct tp_c_library* library = tp_c_library();
  return decide(handle, name, NULL, caller, library != NULL ? (void*)library->next_dlsym : NULL);
}

struct tp_verdict tp_filter_dlvsym(void* handle, const char* name, const char* version, const void* caller) {
  const struct tp_c_library* library = tp_c_library();
  return decide(handle, name, version, caller, library != NULL ? (void*)library->next_dlvsym : NULL);
}
