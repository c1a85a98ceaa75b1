// Byte permutes (AVX-512 VBMI): the compiler's intrinsics and the attribute of functions that use them.
// Highway 1.0 has no byte permutes across a whole vector. For x86-64 only.
#pragma once

#if defined(__x86_64__)

#ifndef __clang__  // GCC 12 warns about undefined values in its own header (GCC bug 105593)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>

#define TILEPRESS_VBMI                                                                                  \
  __attribute__((                                                                                       \
      target("avx512f,avx512bw,avx512dq,avx512vl,avx512cd,avx512vbmi,avx512vbmi2,avx512vpopcntdq,gfni," \
             "bmi,bmi2,popcnt")))
#define TILEPRESS_VBMI_INLINE TILEPRESS_VBMI __attribute__((always_inline)) inline

#endif
