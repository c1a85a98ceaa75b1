// GL hooks: the GL calls that end a frame without presenting it (--trigger), and those by which a program
// draws to and turns away from its own framebuffers (--targets). Without these options none is answered by a
// lookup.
#pragma once

#include <stdbool.h>
#include <stdint.h>

// The line of `name` in gl_names.def, or -1.
int tp_find_gl(const char* name);

// Whether a lookup of line `name` can find anything but the real function: without an option only the
// exported names.
bool tp_gl_concerns(int name);

// What a lookup must answer for line `name` of gl_names.def where the real answer is `real`: a stub in front
// of it, or `real` itself where the call is not watched. `always`: also a trigger that is not asked for
// (OSMesa's).
void* tp_gl_answer(int name, void* real, bool always);

// A program's glXMakeCurrent and the like: a watched call that is a hook already. `arguments` as
// TilepressGlCall's.
void tp_gl_making_current(uint32_t kind, const uintptr_t* arguments);

// A thread has made an OSMesa context current, or none (`real` = NULL): from now on glFinish and glFlush are
// watched. `swaps` = its frames end with glfwSwapBuffers instead.
void tp_gl_osmesa_current(void* real, bool swaps);
// That function, or NULL.
void* tp_gl_osmesa(void);
