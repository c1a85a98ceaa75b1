// GL slots: how many there are. Read by the compiler and by the assembler.
#pragma once

#define TP_GL_POOL 1024    // slots behind those of the names, bound as functions are looked up
#define TP_GL_KIND_DRAW 0  // TILEPRESS_GL_DRAW

// Every name has the slot of its number in the list; TP_GL_NAMES is their count.
#ifdef __ASSEMBLER__
.set TP_GL_NAMES, 0
#define TP_GL_TRIGGER(name, kind) .set TP_GL_NAMES, TP_GL_NAMES + 1;
#define TP_GL_TARGET(name, kind) .set TP_GL_NAMES, TP_GL_NAMES + 1;
#include "gl_names.def"
#else
enum tp_gl_name {
#define TP_GL_TRIGGER(name, kind) TP_GL_NAME_##name,
#define TP_GL_TARGET(name, kind) TP_GL_NAME_##name,
#include "gl_names.def"
  TP_GL_NAMES
};
#endif
