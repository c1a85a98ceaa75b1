// GL calls: some end a frame without presenting it (--trigger). By others a program draws to its own
// framebuffers and turns away from them (--targets). The stubs of gl_stubs_*.S report both here.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "../engine_contract.h"
#include "gl_slots.h"

// The stubs read these fields and jump to `real`.
struct tp_gl_slot {
  void* real;     // NULL until the first call, or until the slot is bound
  uint64_t kind;  // enum TilepressGlKind
};

enum { TP_GL_NAME_SIZE = 56 };  // bytes of the longest name with its zero

// Hidden arrays: they can be read before the dynamic linker has relocated this library.
#pragma GCC visibility push(hidden)
extern struct tp_gl_slot tp_gl_slots[TP_GL_NAMES + TP_GL_POOL];
extern const char tp_gl_names[TP_GL_NAMES][TP_GL_NAME_SIZE];
#pragma GCC visibility pop

// Returns true if the options ask for calls of `kind`.
bool tp_gl_is_wanted(uint64_t kind);
// Returns true for the kinds of --trigger. Their names are always exported; OSMesa needs two without an
// option.
bool tp_gl_is_trigger(uint64_t kind);

// A hook of glXMakeCurrent and the like reports its call. `arguments`: as in TilepressGlCall.
void tp_gl_making_current(uint32_t kind, const uintptr_t* arguments);

// The thread has made an OSMesa context current with `real`, or none (NULL): from the first on, glFinish and
// glFlush are watched. `swaps`: its frames end with glfwSwapBuffers instead.
void tp_gl_osmesa_current(void* real, bool swaps);
// Returns `real` of the thread's last tp_gl_osmesa_current, or NULL.
void* tp_gl_osmesa(void);
