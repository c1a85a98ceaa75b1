// Landing pad: the instruction that an indirect jump may reach where the processor checks it (CET, BTI), and
// the notes that every object file of assembly needs. For assembly.
#pragma once
// clang-format off

#if defined(__x86_64__)
#if __has_include(<cet.h>)
#include <cet.h>
#endif
#ifndef _CET_ENDBR
#define _CET_ENDBR endbr64
#endif
#define LANDING_PAD _CET_ENDBR
#elif defined(__aarch64__)
#define LANDING_PAD hint #34  // bti c
  .section .note.gnu.property, "a"
  .p2align 3
  .long 4, 16, 5
  .asciz "GNU"
  .long 0xc0000000, 4, 1, 0   // GNU_PROPERTY_AARCH64_FEATURE_1_BTI
#endif
  .section .note.GNU-stack, "", %progbits
  .text
