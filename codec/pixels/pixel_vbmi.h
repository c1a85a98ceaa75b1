// Pixel kernels by AVX-512 VBMI, and the loads that other byte-permute kernels share.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__x86_64__)
#include "cpu/vbmi.h"

namespace tilepress {

// See PixelKernels.
bool load_traversal_by_vbmi(const uint32_t* top_left, uint32_t stride, uint32_t* pixels);
uint32_t solid_blocks_by_vbmi(const uint32_t* top_left, uint32_t stride, uint32_t color, uint32_t most);
uint64_t run_begins_by_vbmi(const uint32_t* pixels);

namespace vbmi {

/// A block in traversal order: four vectors of sixteen pixels.
struct BlockWords {
  __m512i of[4];
};

TILEPRESS_VBMI_INLINE BlockWords words_of(const uint32_t* pixels) {
  BlockWords words;
  for (uint32_t i = 0; i < 4; ++i) words.of[i] = _mm512_loadu_si512(pixels + 16 * i);
  return words;
}

TILEPRESS_VBMI_INLINE __m512i two_rows(const uint32_t* row, uint32_t stride) {
  const __m256i upper = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row));
  return _mm512_inserti64x4(_mm512_castsi256_si512(upper),
                            _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row + stride)), 1);
}

/// See PixelKernels::load_traversal; the block is in `words` too.
TILEPRESS_VBMI_INLINE bool load(const uint32_t* top_left, uint32_t stride, uint32_t* pixels,
                                BlockWords& words) {
  // Interleaves pairs of pixels of two rows: sub-blocks.
  const __m512i order = _mm512_setr_epi64(0, 4, 1, 5, 2, 6, 3, 7);
  const __m512i first = _mm512_set1_epi32(static_cast<int>(*top_left));
  __m512i difference = _mm512_setzero_si512();
  for (uint32_t i = 0; i < 4; ++i) {
    words.of[i] = _mm512_permutexvar_epi64(order, two_rows(top_left + size_t{2 * i} * stride, stride));
    _mm512_storeu_si512(pixels + 16 * i, words.of[i]);
    difference =
        _mm512_ternarylogic_epi64(difference, words.of[i], first, 0xF6);  // difference | words ^ first
  }
  return _mm512_test_epi64_mask(difference, difference) == 0;
}

/// See PixelKernels::run_begins. Compares neighbours in registers: a load that overlaps two recent stores
/// would wait for them.
TILEPRESS_VBMI_INLINE uint64_t run_begins(const BlockWords& words) {
  uint64_t begins = 1;
  for (uint32_t i = 0; i < 4; ++i) {
    const __m512i before = _mm512_alignr_epi32(words.of[i], words.of[i == 0 ? 0 : i - 1], 15);
    const __mmask16 differs = _mm512_cmpneq_epi32_mask(words.of[i], before);
    begins |= uint64_t{i == 0 ? differs & 0xFFFEu : differs} << 16 * i;
  }
  return begins;
}

}  // namespace vbmi
}  // namespace tilepress
#endif
