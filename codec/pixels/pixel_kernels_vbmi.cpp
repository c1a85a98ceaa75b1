// Pixel kernels by AVX-512 VBMI.
#include "pixels/pixel_vbmi.h"

#if defined(__x86_64__)

namespace tilepress {

TILEPRESS_VBMI bool load_traversal_by_vbmi(const uint32_t* top_left, uint32_t stride, uint32_t* pixels) {
  vbmi::BlockWords words;
  return vbmi::load(top_left, stride, pixels, words);
}

// Two blocks at a time.
TILEPRESS_VBMI uint32_t solid_blocks_by_vbmi(const uint32_t* top_left, uint32_t stride, uint32_t color,
                                             uint32_t most) {
  const __m512i wanted = _mm512_set1_epi32(static_cast<int>(color));
  for (uint32_t n = 0; n < most; n += 2, top_left += 16) {
    const auto inside = static_cast<__mmask16>(n + 1 < most ? 0xFFFF : 0x00FF);
    __m512i difference = _mm512_setzero_si512();
    for (uint32_t y = 0; y < 8; ++y)
      difference = _mm512_ternarylogic_epi64(
          difference, _mm512_maskz_loadu_epi32(inside, top_left + size_t{y} * stride), wanted, 0xF6);
    const __mmask16 differs = _mm512_mask_test_epi32_mask(inside, difference, difference);
    if (differs != 0) return n + ((differs & 0xFF) == 0);
  }
  return most;
}

TILEPRESS_VBMI uint64_t run_begins_by_vbmi(const uint32_t* pixels) {
  return vbmi::run_begins(vbmi::words_of(pixels));
}

}  // namespace tilepress
#endif
