// Clone into a task, on AArch64 (surviving_task.cpp). See task_x86_64.S for the contract.
#if defined(__aarch64__)
  .text
  .globl tilepress_clone_task
  .hidden tilepress_clone_task
  .type tilepress_clone_task, %function
tilepress_clone_task:
  .cfi_startproc
  hint #34                     // bti c
  stp x29, x30, [sp, #-32]!
  .cfi_def_cfa_offset 32
  .cfi_offset x29, -32
  .cfi_offset x30, -24
  stp x19, x20, [sp, #16]
  .cfi_offset x19, -16
  .cfi_offset x20, -8
  mov x29, sp
  .cfi_def_cfa_register x29
  mov x19, x0
  mov x0, x1
  mov x1, #0                   // no stack of its own: the child goes on here
  mov x2, #0
  mov x3, #0
  mov x4, #0
  mov x8, #220                 // clone
  svc #0
  cmp x0, #0
  b.lt 2f
  b.eq 3f
  mov x20, x0
  ldr x9, [x19, #16]           // parking_stack: this stack is the child's from here on
  mov sp, x9
  mov x0, #2                   // SIG_SETMASK
  add x1, x19, #24             // signals
  mov x2, #0
  mov x3, #8
  mov x8, #135                 // rt_sigprocmask
  svc #0
1:
  mov x0, x20
  mov x1, #0
  mov x2, #0x40000000          // __WALL
  mov x3, #0
  mov x8, #260                 // wait4
  svc #0
  cmn x0, #4                   // EINTR: setuid() and its kin signal every thread
  b.eq 1b
  mov x0, #0
2:
  mov sp, x29
  ldp x19, x20, [sp, #16]
  ldp x29, x30, [sp], #32
  ret
3:
  ldr x0, [x19, #8]            // argument
  ldr x9, [x19]                // work
  blr x9
  mov x0, #0
  mov x8, #94                  // exit_group
  svc #0
  brk #0
  .cfi_endproc
  .size tilepress_clone_task, .-tilepress_clone_task
#endif
  .section .note.GNU-stack, "", %progbits
