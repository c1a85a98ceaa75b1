// GL exports: the names that linked callers reach. Each enters the slot of its number in gl_names.def.
#if __has_include(<cet.h>)
#include <cet.h>
#endif
#ifndef _CET_ENDBR
#define _CET_ENDBR endbr64
#endif

  .macro gl_export function
  .globl \function
  .type \function, %function
  .p2align 4
\function:
#if defined(__x86_64__)
  _CET_ENDBR
  movl $slot, %r11d
  jmp tp_gl_enter
#elif defined(__aarch64__)
  hint #34                    // bti c
  mov w17, #slot
  b tp_gl_enter
#endif
  .size \function, .-\function
  .set slot, slot + 1
  .endm

  .text
  .set slot, 0
#define TP_GL_TRIGGER(name, kind) gl_export name;
#ifdef TP_GL_EXPORT_ALL
#define TP_GL_TARGET(name, kind) gl_export name;
#else
#define TP_GL_TARGET(name, kind) .set slot, slot + 1;
#endif
#include "gl_names.def"

#if defined(__aarch64__)
  .section .note.gnu.property, "a"
  .p2align 3
  .long 4, 16, 5
  .asciz "GNU"
  .long 0xc0000000, 4, 1, 0   // GNU_PROPERTY_AARCH64_FEATURE_1_BTI
#endif
  .section .note.GNU-stack, "", %progbits
