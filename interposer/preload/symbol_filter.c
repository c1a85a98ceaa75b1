// Symbol filter: decides, for every dlsym and dlvsym of the process, who answers.
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

// What the trampoline does next: jump to the real function with stack and registers as its caller left them,
// or return `answer`. (Returned in two registers on x86-64 and AArch64.)
struct tp_verdict {
  void* jump_to;
  void* answer;
};

// With any handle but RTLD_NEXT, which is relative to who calls, another interposer's answer counts too.
static void* look_up(void* handle, const char* name, const char* version) {
  const struct tp_c_library* library = tp_c_library();
  const bool next = handle == RTLD_NEXT;
  if (version != NULL) return (next ? library->dlvsym : library->next_dlvsym)(handle, name, version);
  return (next ? library->dlsym : library->next_dlsym)(handle, name);
}

// An ANGLE handle is left alone: ANGLE's frames are seen one level down, at the library it draws with.
static bool is_angle(const void* function) {
  return tp_symbol_in_object_of(function, "eglStreamPostD3DTextureANGLE") != NULL ||
         tp_symbol_in_object_of(function, "ANGLEGetDisplayPlatform") != NULL;  // its libGLESv2
}

// RTLD_NEXT finds our export only where the caller stands before us in load order.
static bool next_is_ours(const void* caller) {
  const int position = tp_load_position(caller);
  return position >= 0 && position < tp_load_position((const void*)&next_is_ours);
}

// The lookup would have found our own export: what would it have found without us?
static void* look_past_us(void* handle, const char* name, const char* version, const void* caller) {
  void* found = look_up(RTLD_NEXT, name, version);
  if (found != NULL || handle != RTLD_DEFAULT) return found;
  // The caller may be a plugin with libraries of its own, which the global scope does not show.
  void* object = tp_handle_of_object(caller);
  if (object != NULL) found = look_up(object, name, version);
  if (found != NULL && !tp_is_ours(found)) {
    tp_c_library()->dlerror();  // a success leaves no message behind
    return found;
  }
  return look_up(RTLD_NEXT, name, version);  // nothing, and dlerror says so
}

// A dlsym of the program's own finds the one beneath with dlvsym, because the C library's has a version. Ours
// has none and would be passed by: it stands in for what it forwards to.
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
    if (real == NULL) return forward;  // the real function says so again, with the caller's own dlerror
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

// Called by the trampolines only.
struct tp_verdict tp_filter_dlsym(void* handle, const char* name, const void* caller) {
  const struct tp_c_library* library = tp_c_library();
  return decide(handle, name, NULL, caller, library != NULL ? (void*)library->next_dlsym : NULL);
}

struct tp_verdict tp_filter_dlvsym(void* handle, const char* name, const char* version, const void* caller) {
  const struct tp_c_library* library = tp_c_library();
  return decide(handle, name, version, caller, library != NULL ? (void*)library->next_dlvsym : NULL);
}
