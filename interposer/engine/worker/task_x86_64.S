// Clone into a task, on x86-64 (surviving_task.cpp).
#if defined(__x86_64__)
// long tilepress_clone_task(const struct TaskStart* start, unsigned long flags)
// The child runs start->work(start->argument) on the caller's stack and ends. The parent waits for that end
// on start->parking_stack with the signal mask start->signals, and returns 0; or a negative errno if the
// kernel refused to clone.
  .text
  .globl tilepress_clone_task
  .hidden tilepress_clone_task
  .type tilepress_clone_task, @function
tilepress_clone_task:
  .cfi_startproc
  endbr64
  pushq %rbp
  .cfi_def_cfa_offset 16
  .cfi_offset %rbp, -16
  movq %rsp, %rbp
  .cfi_def_cfa_register %rbp
  pushq %rbx
  .cfi_offset %rbx, -24
  pushq %r12
  .cfi_offset %r12, -32
  movq %rdi, %rbx
  movq %rsi, %rdi
  xorl %esi, %esi              // no stack of its own: the child goes on here
  xorl %edx, %edx
  xorl %r10d, %r10d
  xorl %r8d, %r8d
  movl $56, %eax               // clone
  syscall
  testq %rax, %rax
  js 2f
  jz 3f
  movq %rax, %r12
  movq 16(%rbx), %rsp          // parking_stack: this stack is the child's from here on
  movl $2, %edi                // SIG_SETMASK
  leaq 24(%rbx), %rsi          // signals
  xorl %edx, %edx
  movl $8, %r10d
  movl $14, %eax               // rt_sigprocmask
  syscall
1:
  movq %r12, %rdi
  xorl %esi, %esi
  movl $0x40000000, %edx       // __WALL
  xorl %r10d, %r10d
  movl $61, %eax               // wait4
  syscall
  cmpq $-4, %rax               // EINTR: setuid() and its kin signal every thread
  je 1b
  xorl %eax, %eax
2:
  leaq -16(%rbp), %rsp
  popq %r12
  popq %rbx
  popq %rbp
  .cfi_remember_state
  .cfi_def_cfa %rsp, 8
  ret
  .cfi_restore_state
3:
  movq 8(%rbx), %rdi           // argument
  callq *(%rbx)                // work
  xorl %edi, %edi
  movl $231, %eax              // exit_group
  syscall
  hlt
  .cfi_endproc
  .size tilepress_clone_task, .-tilepress_clone_task

// What a signal handler returns to.
  .globl tilepress_signal_return
  .hidden tilepress_signal_return
  .type tilepress_signal_return, @function
tilepress_signal_return:
  movl $15, %eax               // rt_sigreturn
  syscall
  .size tilepress_signal_return, .-tilepress_signal_return
#endif
  .section .note.GNU-stack, "", %progbits
