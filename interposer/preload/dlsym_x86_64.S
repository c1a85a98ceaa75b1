// Trampolines (x86-64): dlsym and dlvsym call the filter, then jump to the real function with the caller's stack and
// return address. The real functions identify their caller by the return address (RTLD_NEXT).
#include "landing_pad.h"
#if defined(__x86_64__)
  .macro trampoline function, filter, caller_register
  .globl \function
  .type \function, @function
  .p2align 4
\function:
  .cfi_startproc
  LANDING_PAD
  pushq %rdi
  .cfi_adjust_cfa_offset 8
  pushq %rsi
  .cfi_adjust_cfa_offset 8
  pushq %rdx
  .cfi_adjust_cfa_offset 8
  movq 24(%rsp), \caller_register
  call \filter
  movq %rdx, %r11
  popq %rdx
  .cfi_adjust_cfa_offset -8
  popq %rsi
  .cfi_adjust_cfa_offset -8
  popq %rdi
  .cfi_adjust_cfa_offset -8
  testq %rax, %rax
  je 1f
  jmp *%rax
1:
  movq %r11, %rax
  ret
  .cfi_endproc
  .size \function, .-\function
  .endm

  trampoline dlsym, tp_filter_dlsym, %rdx
  trampoline dlvsym, tp_filter_dlvsym, %rcx
#endif
