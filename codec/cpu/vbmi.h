// Byte permutes (AVX-512 VBMI): the compiler's intrinsics and the attribute of functions that use them.
// Highway 1.0 has no byte permutes across a whole vector. For x86-64 only.
#pragma once

#if defined(__x86_64__)

#ifndef __clang__  // GCC 12 warns about undefined values in its own header (GCC bug 105593)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>

#include <cstdint>

#define TILEPRESS_VBMI                                                                                  \
  __attribute__((                                                                                       \
      target("avx512f,avx512bw,avx512dq,avx512vl,avx512cd,avx512vbmi,avx512vbmi2,avx512vpopcntdq,gfni," \
             "bmi,bmi2,popcnt")))
#define TILEPRESS_VBMI_INLINE TILEPRESS_VBMI __attribute__((always_inline)) inline

namespace tilepress {

/// Returns the low bytes of 64 numbers of 16 bits.
TILEPRESS_VBMI_INLINE __m512i index_bytes(const uint16_t* indices) {
  const __m256i low = _mm512_cvtepi16_epi8(_mm512_loadu_si512(indices));
  const __m256i high = _mm512_cvtepi16_epi8(_mm512_loadu_si512(indices + 32));
  return _mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
}

}  // namespace tilepress
#endif
