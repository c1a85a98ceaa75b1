// Trampolines (AArch64): like those for x86-64. x16 carries the jump, so that the real function's "bti c" accepts it.
#include "landing_pad.h"
#if defined(__aarch64__)
  .macro trampoline function, filter, caller_register
  .globl \function
  .type \function, %function
  .p2align 4
\function:
  .cfi_startproc
  LANDING_PAD
  stp x29, x30, [sp, #-48]!
  .cfi_adjust_cfa_offset 48
  .cfi_rel_offset x29, 0
  .cfi_rel_offset x30, 8
  mov x29, sp
  stp x0, x1, [sp, #16]
  str x2, [sp, #32]
  mov \caller_register, x30
  bl \filter
  mov x16, x0
  mov x17, x1
  ldp x0, x1, [sp, #16]
  ldr x2, [sp, #32]
  ldp x29, x30, [sp], #48
  .cfi_adjust_cfa_offset -48
  .cfi_restore x29
  .cfi_restore x30
  cbz x16, 1f
  br x16
1:
  mov x0, x17
  ret
  .cfi_endproc
  .size \function, .-\function
  .endm

  trampoline dlsym, tp_filter_dlsym, x2
  trampoline dlvsym, tp_filter_dlvsym, x3
#endif
