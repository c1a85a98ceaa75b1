// GL exports: the names that linked callers reach. Each enters the slot of its number in gl_names.def.
#include "landing_pad.h"

  .macro gl_export function
  .globl \function
  .type \function, %function
  .p2align 4
\function:
  LANDING_PAD
#if defined(__x86_64__)
  movl $slot, %r11d
  jmp tp_gl_enter
#elif defined(__aarch64__)
  mov w17, #slot
  b tp_gl_enter
#endif
  .size \function, .-\function
  .set slot, slot + 1
  .endm
  .set slot, 0
#define TP_GL_TRIGGER(name, kind) gl_export name;
#ifdef TP_GL_EXPORT_ALL
#define TP_GL_TARGET(name, kind) gl_export name;
#else
#define TP_GL_TARGET(name, kind) .set slot, slot + 1;
#endif
#include "gl_names.def"
