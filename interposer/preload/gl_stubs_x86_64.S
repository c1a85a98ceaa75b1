// GL stubs (x86-64): a stub stands in front of a watched GL function and needs no signature. It reports the call,
// restores every argument register, and jumps to the real function with the caller's stack and return address.
#include "landing_pad.h"
#if defined(__x86_64__)
#include "gl_slots.h"

// r11: number of the slot {real function, kind}. An unwatched call costs a load, a test and two jumps.
  .globl tp_gl_enter
  .hidden tp_gl_enter
  .type tp_gl_enter, @function
  .p2align 4
tp_gl_enter:
  .cfi_startproc
  shlq $4, %r11
  leaq tp_gl_slots(%rip), %r10
  addq %r11, %r10
  movq (%r10), %rax
  testq %rax, %rax
  je 2f
  movl 8(%r10), %r11d
  btl %r11d, tp_gl_wanted(%rip)
  jnc 1f
  cmpl $TP_GL_KIND_DRAW, %r11d
  jne 2f
  movq tp_gl_drawn_at@GOTTPOFF(%rip), %r11
  movq %fs:(%r11), %r11
  testq %r11, %r11
  je 2f
  movb $1, (%r11)
1:
  jmp *%rax
2:
  pushq %rbp
  .cfi_adjust_cfa_offset 8
  .cfi_rel_offset %rbp, 0
  movq %rsp, %rbp
  .cfi_def_cfa_register %rbp
  subq $176, %rsp
  movq %rdi, (%rsp)
  movq %rsi, 8(%rsp)
  movq %rdx, 16(%rsp)
  movq %rcx, 24(%rsp)
  movq %r8, 32(%rsp)
  movq %r9, 40(%rsp)
  .irp n, 0, 1, 2, 3, 4, 5, 6, 7
  movaps %xmm\n, 48 + 16 * \n(%rsp)
  .endr
  movq %r10, %rdi
  movq %rsp, %rsi
  movq 8(%rbp), %rdx
  call tp_gl_before
  movq (%rsp), %rdi
  movq 8(%rsp), %rsi
  movq 16(%rsp), %rdx
  movq 24(%rsp), %rcx
  movq 32(%rsp), %r8
  movq 40(%rsp), %r9
  .irp n, 0, 1, 2, 3, 4, 5, 6, 7
  movaps 48 + 16 * \n(%rsp), %xmm\n
  .endr
  leave
  .cfi_def_cfa %rsp, 8
  testq %rax, %rax
  je 3f
  jmp *%rax
3:
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
  movl $slot, %r11d
  jmp tp_gl_enter
  .p2align 4
  .set slot, slot + 1
  .endr
  .size tp_gl_pool, .-tp_gl_pool
#endif
