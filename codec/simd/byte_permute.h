// Byte permutes: what a file of AVX-512 VBMI intrinsics needs, and what one such file takes from another.
// For x86-64 only.
#pragma once

#ifndef __clang__  // GCC 12 takes what its own header leaves undefined for a mistake (its bug 105593)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>

#include "simd/kernels.h"

#define TILEPRESS_VBMI                                                                                  \
  __attribute__((                                                                                       \
      target("avx512f,avx512bw,avx512dq,avx512vl,avx512cd,avx512vbmi,avx512vbmi2,avx512vpopcntdq,gfni," \
             "bmi,bmi2,popcnt")))
#define TILEPRESS_VBMI_INLINE TILEPRESS_VBMI __attribute__((always_inline)) inline

namespace tilepress {

// Of Kernels: the bits of a block, in kernels_byte_permute_bits.cpp.
uint32_t code_sum_by_permutes(const uint16_t* indices, const uint8_t* lengths, uint32_t raw_bits);
WrittenBlock write_sub_blocks_by_permutes(const uint32_t* pixels, const uint16_t* indices,
                                          const uint8_t* widths, uint32_t mark_bits, uint8_t* out);
uint32_t read_indices_by_permutes(const uint8_t* bytes, const uint64_t marks[2], uint32_t mark_bits,
                                  uint32_t most_bits, const uint32_t* colors, uint32_t known,
                                  uint32_t* raster);

}  // namespace tilepress
