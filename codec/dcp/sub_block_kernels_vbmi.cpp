// Sub-block kernels by AVX-512 VBMI.
#include "dcp/sub_block_kernels.h"

#if defined(__x86_64__)
#include "cpu/vbmi.h"
#include "tilepress/block.h"

namespace tilepress {
namespace {

constexpr uint32_t kLineBytes = 64;

/// Joins the four indices of each sub-block, the first on top, `widths` ≤ 7 bits each.
TILEPRESS_VBMI_INLINE __m512i packed_indices(const uint16_t* indices, __m512i widths) {
  const __m512i bytes = index_bytes(indices);
  const __m512i one = _mm512_set1_epi32(1);
  // Joins pairs of indices, the first · 2^width + the second, and then pairs of pairs.
  const __m512i by_width = _mm512_sllv_epi32(_mm512_set1_epi32(0x00010001), widths);
  const __m512i pairs = _mm512_maddubs_epi16(_mm512_or_si512(by_width, _mm512_set1_epi32(0x01000100)), bytes);
  const __m512i by_two_widths = _mm512_sllv_epi32(one, _mm512_add_epi32(widths, widths));
  return _mm512_madd_epi16(pairs, _mm512_or_si512(by_two_widths, _mm512_set1_epi32(0x00010000)));
}

/// Splits eight words into nibbles, one per byte, from the top of each word.
TILEPRESS_VBMI_INLINE __m512i nibbles_of(__m256i words) {
  const __m512i places = _mm512_set1_epi64(0x0004080C1014181C);
  return _mm512_and_si512(_mm512_multishift_epi64_epi8(places, _mm512_cvtepu32_epi64(words)),
                          _mm512_set1_epi8(0x0F));
}

/// Writes sub-blocks that are all indices, 64 bytes; returns the number of bits wanted. Of the nibbles of the
/// packed words the last `widths` are joined.
TILEPRESS_VBMI_INLINE uint32_t write_packed(__m512i packed, __m512i widths, uint8_t* out) {
  const __m128i last = _mm512_cvtepi32_epi8(
      _mm512_sllv_epi32(_mm512_set1_epi32(0xFF), _mm512_sub_epi32(_mm512_set1_epi32(8), widths)));
  const auto wanted = static_cast<uint64_t>(_mm_cvtsi128_si64(last));
  const auto then_wanted = static_cast<uint64_t>(_mm_extract_epi64(last, 1));
  const auto count = static_cast<uint32_t>(__builtin_popcountll(wanted));  // at most 56
  const __m512i first = _mm512_maskz_compress_epi8(wanted, nibbles_of(_mm512_castsi512_si256(packed)));
  const __m512i then =
      _mm512_maskz_compress_epi8(then_wanted, nibbles_of(_mm512_extracti64x4_epi64(packed, 1)));
  const __m512i low = _mm512_or_si512(first, _mm512_maskz_expand_epi8(~uint64_t{0} << count, then));
  const __m512i high = _mm512_maskz_compress_epi8(~(~uint64_t{0} >> count), then);
  const __m512i two = _mm512_set1_epi16(0x0110);  // nibbles to a byte, the first on top
  const __m256i low_bytes = _mm512_cvtepi16_epi8(_mm512_maddubs_epi16(low, two));
  const __m256i high_bytes = _mm512_cvtepi16_epi8(_mm512_maddubs_epi16(high, two));
  _mm512_storeu_si512(out, _mm512_inserti64x4(_mm512_castsi256_si512(low_bytes), high_bytes, 1));
  return 4 * (count + static_cast<uint32_t>(__builtin_popcountll(then_wanted)));
}

/// Repeats each of sixteen bits four times.
TILEPRESS_VBMI_INLINE uint64_t four_of_each(uint32_t bits) {
  return _pdep_u64(bits, 0x1111111111111111) * 15;
}

// The indices of a sub-block begin at a byte or amid one, and take at most 28 bits: four bytes hold them.
TILEPRESS_VBMI uint32_t read_indices(const uint8_t* bytes, const uint64_t marks[2], uint32_t mark_bits,
                                     uint32_t most_bits, const uint32_t* colors, uint32_t known,
                                     uint32_t* raster) {
  const uint64_t places = 0x0101010101010101u * ((1u << mark_bits) - 1);
  const __m128i width8 =
      _mm_set_epi64x(static_cast<long long>(__builtin_bswap64(_pdep_u64(marks[1], places))),
                     static_cast<long long>(__builtin_bswap64(_pdep_u64(marks[0], places))));
  if (_mm_cmpgt_epu8_mask(width8, _mm_set1_epi8(static_cast<char>(most_bits))) != 0) return kNotAllIndices;
  // The beginning and the end of each sub-block in nibbles: a sub-block has as many nibbles as its width.
  __m128i end8 = _mm_add_epi8(width8, _mm_bslli_si128(width8, 1));
  end8 = _mm_add_epi8(end8, _mm_bslli_si128(end8, 2));
  end8 = _mm_add_epi8(end8, _mm_bslli_si128(end8, 4));
  end8 = _mm_add_epi8(end8, _mm_bslli_si128(end8, 8));
  const __m512i width = _mm512_cvtepu8_epi32(width8), begin = _mm512_cvtepu8_epi32(_mm_bslli_si128(end8, 1));
  const __m512i one = _mm512_set1_epi32(1);
  const __m512i four_bytes =
      _mm512_add_epi32(_mm512_mullo_epi32(_mm512_srli_epi32(begin, 1), _mm512_set1_epi32(0x01010101)),
                       _mm512_set1_epi32(0x00010203));
  __m512i packed = _mm512_permutexvar_epi8(four_bytes, _mm512_loadu_si512(bytes));
  packed = _mm512_sllv_epi32(packed, _mm512_slli_epi32(_mm512_and_si512(begin, one), 2));
  packed = _mm512_srlv_epi32(packed, _mm512_sub_epi32(_mm512_set1_epi32(32), _mm512_slli_epi32(width, 2)));
  const __m512i mask = _mm512_sub_epi32(_mm512_sllv_epi32(one, width), one);
  __m512i index[4];  // of pixel i of each sub-block
  for (int i = 3; i >= 0; --i, packed = _mm512_srlv_epi32(packed, width))
    index[i] = _mm512_and_si512(packed, mask);
  const __m512i largest =
      _mm512_max_epu32(_mm512_max_epu32(index[0], index[1]), _mm512_max_epu32(index[2], index[3]));
  if (_mm512_cmpge_epu32_mask(largest, _mm512_set1_epi32(static_cast<int>(known))) != 0)
    return kNotAllIndices;
  __m512i pixels[4];
  for (uint32_t i = 0; i < 4; ++i) {
    pixels[i] =
        _mm512_permutex2var_epi32(_mm512_loadu_si512(colors), index[i], _mm512_loadu_si512(colors + 16));
    if (known > 32)
      pixels[i] = _mm512_mask_mov_epi32(pixels[i], _mm512_test_epi32_mask(index[i], _mm512_set1_epi32(32)),
                                        _mm512_permutex2var_epi32(_mm512_loadu_si512(colors + 32), index[i],
                                                                  _mm512_loadu_si512(colors + 48)));
  }
  // Four sub-blocks side by side fill a lane with half of their upper and lower rows.
  const __m512i upper[2] = {_mm512_unpacklo_epi32(pixels[0], pixels[1]),
                            _mm512_unpackhi_epi32(pixels[0], pixels[1])};
  const __m512i lower[2] = {_mm512_unpacklo_epi32(pixels[2], pixels[3]),
                            _mm512_unpackhi_epi32(pixels[2], pixels[3])};
  const __m512i upper01 = _mm512_shuffle_i64x2(upper[0], upper[1], 0x44);
  const __m512i upper23 = _mm512_shuffle_i64x2(upper[0], upper[1], 0xEE);
  const __m512i lower01 = _mm512_shuffle_i64x2(lower[0], lower[1], 0x44);
  const __m512i lower23 = _mm512_shuffle_i64x2(lower[0], lower[1], 0xEE);
  _mm512_storeu_si512(raster, _mm512_shuffle_i64x2(upper01, lower01, 0x88));
  _mm512_storeu_si512(raster + 16, _mm512_shuffle_i64x2(upper01, lower01, 0xDD));
  _mm512_storeu_si512(raster + 32, _mm512_shuffle_i64x2(upper23, lower23, 0x88));
  _mm512_storeu_si512(raster + 48, _mm512_shuffle_i64x2(upper23, lower23, 0xDD));
  return 4 * (static_cast<uint32_t>(_mm_extract_epi16(end8, 7)) >> 8);
}

/// Returns the nibble before each sub-block that begins amid a byte: the last nibble of the nearest sub-block
/// before that has any bits.
TILEPRESS_VBMI_INLINE __m512i nibbles_before(const uint32_t* pixels, __m512i packed, __m128i width8,
                                             __mmask16 raw, uint32_t amid) {
  const __m512i fourth_of_two = _mm512_setr_epi32(3, 7, 11, 15, 19, 23, 27, 31, 0, 0, 0, 0, 0, 0, 0, 0);
  const auto fourth_of = [&](uint32_t half) TILEPRESS_VBMI {
    const uint32_t* words = pixels + half * kBlockPixels / 2;
    return _mm512_castsi512_si256(
        _mm512_permutex2var_epi32(_mm512_loadu_si512(words), fourth_of_two, _mm512_loadu_si512(words + 16)));
  };
  const __m512i fourth = _mm512_inserti64x4(_mm512_castsi256_si512(fourth_of(0)), fourth_of(1), 1);
  const __m512i last = _mm512_and_si512(_mm512_mask_mov_epi32(packed, raw, fourth), _mm512_set1_epi32(15));
  const __mmask16 any = _mm_test_epi8_mask(width8, width8);
  const __m512i those_before =
      _mm512_setr_epi32(0, 1, 3, 7, 15, 31, 63, 127, 255, 511, 1023, 2047, 4095, 8191, 16383, 32767);
  const __m512i number = _mm512_popcnt_epi32(_mm512_and_si512(those_before, _mm512_set1_epi32(any)));
  return _mm512_maskz_permutexvar_epi32(static_cast<__mmask16>(amid),
                                        _mm512_sub_epi32(number, _mm512_set1_epi32(1)),
                                        _mm512_maskz_compress_epi32(any, last));
}

// The bits of a sub-block are a multiple of four, so that a sub-block begins at a byte or amid one. This lays
// each of the sixteen out in 16 bytes as memory holds it, with the nibble before on top if it begins amid a
// byte. Then it stores them in order, each over the zeros behind the sub-block before.
TILEPRESS_VBMI WrittenBlock write_sub_blocks(const uint32_t* pixels, const uint16_t* indices,
                                             const uint8_t* widths, uint32_t mark_bits, uint8_t* out) {
  const auto marks_at = [&](uint32_t sub) TILEPRESS_VBMI {
    uint64_t eight;
    __builtin_memcpy(&eight, widths + sub, 8);
    return _pext_u64(__builtin_bswap64(eight), 0x0101010101010101u * ((1u << mark_bits) - 1));
  };
  WrittenBlock written = {kBlockPixels * 32, kBlockPixels * 4, {marks_at(0), marks_at(8)}};
  const __m512i big_endian =
      _mm512_broadcast_i32x4(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  const __m128i width8 = _mm_loadu_si128(reinterpret_cast<const __m128i*>(widths));
  const __mmask16 raw = _mm_movepi8_mask(width8);  // kRawWidth alone has the top bit
  if (raw == 0xFFFF) {
    for (uint32_t i = 0; i < kBlockPixels; i += 16)
      _mm512_storeu_si512(out + 4 * i, _mm512_shuffle_epi8(_mm512_loadu_si512(pixels + i), big_endian));
    return written;
  }
  const __m512i width = _mm512_cvtepu8_epi32(width8);
  const __m512i packed = packed_indices(indices, width);
  if (raw == 0) {
    written.bits = write_packed(packed, width, out);
    written.clean_bytes = kLineBytes;
    return written;
  }
  alignas(16) uint8_t nibbles[kSubBlocks];  // of each sub-block
  const __m128i nibbles8 = _mm_mask_mov_epi8(width8, raw, _mm_set1_epi8(32));
  _mm_store_si128(reinterpret_cast<__m128i*>(nibbles), nibbles8);
  const __m128i halves = _mm_sad_epu8(nibbles8, _mm_setzero_si128());
  const auto all_nibbles = static_cast<uint32_t>(_mm_cvtsi128_si32(halves) + _mm_extract_epi32(halves, 2));
  const uint32_t last_line = all_nibbles / 2 / kLineBytes * kLineBytes;  // less than all are raw
  _mm512_storeu_si512(out + last_line, _mm512_setzero_si512());
  written.bits = 4 * all_nibbles;
  written.clean_bytes = last_line + kLineBytes;
  // A sub-block begins amid a byte if an odd number of sub-blocks before it have an odd number of nibbles.
  uint32_t amid = (_mm_movepi8_mask(_mm_slli_epi16(width8, 7)) & ~uint32_t{raw}) << 1;
  for (uint32_t step = 1; step < kSubBlocks; step *= 2) amid ^= amid << step;

  const __m512i before = nibbles_before(pixels, packed, width8, raw, amid);
  // The first word of each sub-block: the nibble before, and the indices.
  const __m512i behind = _mm512_sub_epi32(_mm512_set1_epi32(32), _mm512_slli_epi32(width, 2));
  __m512i first = _mm512_maskz_sllv_epi32(static_cast<__mmask16>(~raw), packed, behind);
  first = _mm512_mask_srli_epi32(first, static_cast<__mmask16>(amid), first, 4);
  first = _mm512_shuffle_epi8(_mm512_or_si512(first, _mm512_slli_epi32(before, 28)), big_endian);

  const uint64_t raw_words = four_of_each(raw), amid_words = four_of_each(amid & 0xFFFF);
  __m512i from = _mm512_setr_epi32(0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0);
  uint32_t at = 0;  // in nibbles
  const auto write = [&](__m128i sub_block, uint32_t sub) TILEPRESS_VBMI {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + at / 2), sub_block);
    at += nibbles[sub];
  };
  for (uint32_t sub = 0; sub < kSubBlocks; sub += 4) {
    const __m512i words =
        _mm512_maskz_loadu_epi32(static_cast<__mmask16>(raw_words >> 4 * sub), pixels + 4 * sub);
    const __m512i moved = _mm512_mask_shrdi_epi32(words, static_cast<__mmask16>(amid_words >> 4 * sub), words,
                                                  _mm512_bslli_epi128(words, 4), 4);
    const __m512i firsts = _mm512_maskz_permutexvar_epi32(0x1111, from, first);
    const __m512i four = _mm512_or_si512(_mm512_shuffle_epi8(moved, big_endian), firsts);
    write(_mm512_castsi512_si128(four), sub);
    write(_mm512_extracti32x4_epi32(four, 1), sub + 1);
    write(_mm512_extracti32x4_epi32(four, 2), sub + 2);
    write(_mm512_extracti32x4_epi32(four, 3), sub + 3);
    from = _mm512_add_epi32(from, _mm512_set1_epi32(4));
  }
  // The last raw sub-block has a seventeenth byte if it begins amid a byte.
  if ((raw & amid & 0x8000) != 0) out[at / 2] = static_cast<uint8_t>(pixels[kBlockPixels - 1] << 4);
  return written;
}

}  // namespace

constexpr SubBlockKernels kVbmiSubBlockKernels = {.write = write_sub_blocks, .read = read_indices};

}  // namespace tilepress
#endif
