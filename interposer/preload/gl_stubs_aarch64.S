// GL stubs (AArch64): like those for x86-64. x16 carries the jump, so that the real function's "bti c" accepts it.
#include "landing_pad.h"
#if defined(__aarch64__)
#include "gl_slots.h"

// x17: number of the slot {real function, kind}.
  .globl tp_gl_enter
  .hidden tp_gl_enter
  .type tp_gl_enter, @function
  .p2align 4
tp_gl_enter:
  .cfi_startproc
  adrp x9, tp_gl_slots
  add x9, x9, :lo12:tp_gl_slots
  add x9, x9, x17, lsl #4
  ldr x16, [x9]
  cbz x16, 2f
  ldr w10, [x9, #8]
  adrp x11, tp_gl_wanted
  ldr w11, [x11, :lo12:tp_gl_wanted]
  lsr w11, w11, w10
  tbz w11, #0, 1f
  cmp w10, #TP_GL_KIND_DRAW
  b.ne 2f
  adrp x11, :gottprel:tp_gl_drawn_at
  ldr x11, [x11, :gottprel_lo12:tp_gl_drawn_at]
  mrs x12, tpidr_el0
  ldr x11, [x12, x11]
  cbz x11, 2f
  mov w12, #1
  strb w12, [x11]
1:
  br x16
2:
  stp x29, x30, [sp, #-224]!
  .cfi_adjust_cfa_offset 224
  .cfi_rel_offset x29, 0
  .cfi_rel_offset x30, 8
  mov x29, sp
  stp x0, x1, [sp, #16]
  stp x2, x3, [sp, #32]
  stp x4, x5, [sp, #48]
  stp x6, x7, [sp, #64]
  str x8, [sp, #80]
  stp q0, q1, [sp, #96]
  stp q2, q3, [sp, #128]
  stp q4, q5, [sp, #160]
  stp q6, q7, [sp, #192]
  mov x0, x9
  add x1, sp, #16
  mov x2, x30
  bl tp_gl_before
  mov x16, x0
  ldp x0, x1, [sp, #16]
  ldp x2, x3, [sp, #32]
  ldp x4, x5, [sp, #48]
  ldp x6, x7, [sp, #64]
  ldr x8, [sp, #80]
  ldp q0, q1, [sp, #96]
  ldp q2, q3, [sp, #128]
  ldp q4, q5, [sp, #160]
  ldp q6, q7, [sp, #192]
  ldp x29, x30, [sp], #224
  .cfi_adjust_cfa_offset -224
  .cfi_restore x29
  .cfi_restore x30
  cbz x16, 3f
  br x16
3:
  mov x0, #0
  ret
  .cfi_endproc
  .size tp_gl_enter, .-tp_gl_enter

// The pool: stubs of equal size, bound to functions that lookups find.
  .globl tp_gl_pool
  .hidden tp_gl_pool
  .type tp_gl_pool, @function
  .p2align 4
tp_gl_pool:
  .set slot, TP_GL_NAMES
  .rept TP_GL_POOL
  LANDING_PAD
  mov w17, #slot
  b tp_gl_enter
  .p2align 4
  .set slot, slot + 1
  .endr
  .size tp_gl_pool, .-tp_gl_pool
#endif
