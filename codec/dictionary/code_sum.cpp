// Code sum: the kernel by AVX-512 VBMI, see huffman_blocks.h.
#include "cpu/cpu_target.h"
#include "cpu/vbmi.h"
#include "dictionary/huffman_blocks.h"

namespace tilepress {

#if defined(__x86_64__)
namespace {

TILEPRESS_VBMI uint32_t code_sum(const uint16_t* indices, const uint8_t* lengths, uint32_t raw_bits) {
  const __m512i index = index_bytes(indices);
  const __m512i bits =
      _mm512_mask_mov_epi8(_mm512_permutexvar_epi8(index, _mm512_loadu_si512(lengths)),
                           _mm512_movepi8_mask(index), _mm512_set1_epi8(static_cast<char>(raw_bits)));
  const __m512i pairs = _mm512_maddubs_epi16(bits, _mm512_set1_epi8(1));
  const __m512i sums = _mm512_madd_epi16(pairs, _mm512_set1_epi16(1));
  return static_cast<uint32_t>(
      _mm512_reduce_add_epi32(_mm512_min_epu32(sums, _mm512_set1_epi32(static_cast<int>(raw_bits)))));
}

}  // namespace

CodeSum code_sum_kernel() {
  return cpu_target() == CpuTarget::kAvx512Vbmi ? code_sum : nullptr;
}
#else
CodeSum code_sum_kernel() {
  return nullptr;
}
#endif

}  // namespace tilepress
