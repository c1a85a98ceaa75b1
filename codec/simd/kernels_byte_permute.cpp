// Byte permute kernels: the look-ups of a block where a register of 64 or 128 bytes is a table (AVX-512 VBMI).
// Highway 1.0 has no byte permutes across a whole vector, so these are intrinsics.
#include "simd/kernel_sets.h"

#if defined(__x86_64__)
#ifndef __clang__  // GCC 12 takes what its own header leaves undefined for a mistake (its bug 105593)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>

#define TILEPRESS_VBMI \
  __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx512cd,avx512vbmi,avx512vbmi2,bmi,bmi2,popcnt")))
#define TILEPRESS_VBMI_INLINE TILEPRESS_VBMI __attribute__((always_inline)) inline

namespace tilepress {
namespace {

TILEPRESS_VBMI_INLINE __m512i two_rows(const uint32_t* row, uint32_t stride) {
  const __m256i upper = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row));
  return _mm512_inserti64x4(_mm512_castsi256_si512(upper),
                            _mm256_loadu_si256(reinterpret_cast<const __m256i*>(row + stride)), 1);
}

/// Of four vectors of sixteen pixels, byte `c` of each pixel below and byte `d` above: 64 and 64.
TILEPRESS_VBMI_INLINE void take_bytes(const __m512i (&words)[4], __m512i which, __m512i& low, __m512i& high) {
  const __m512i first = _mm512_permutex2var_epi8(words[0], which, words[1]);
  const __m512i second = _mm512_permutex2var_epi8(words[2], which, words[3]);
  low = _mm512_shuffle_i64x2(first, second, 0x44);
  high = _mm512_shuffle_i64x2(first, second, 0xEE);
}

/// Positions for take_bytes: byte c of 32 pixels, then byte d of them.
struct BytesOf {
  alignas(64) uint8_t at[64];
  constexpr BytesOf(uint32_t c, uint32_t d) : at() {
    for (uint32_t i = 0; i < 32; ++i) {
      at[i] = static_cast<uint8_t>(4 * i + c);
      at[32 + i] = static_cast<uint8_t>(4 * i + d);
    }
  }
};

TILEPRESS_VBMI bool load_traversal(const uint32_t* top_left, uint32_t stride, uint32_t* pixels,
                                   BlockKeys* keys) {
  // Pairs of two rows, interleaved: sub-blocks.
  const __m512i order = _mm512_setr_epi64(0, 4, 1, 5, 2, 6, 3, 7);
  const __m512i first = _mm512_set1_epi32(static_cast<int>(*top_left));
  __m512i words[4], difference = _mm512_setzero_si512();
  for (uint32_t i = 0; i < 4; ++i) {
    words[i] = _mm512_permutexvar_epi64(order, two_rows(top_left + size_t{2 * i} * stride, stride));
    _mm512_storeu_si512(pixels + 16 * i, words[i]);
    difference = _mm512_ternarylogic_epi64(difference, words[i], first, 0xF6);  // difference | words ^ first
  }
  if (_mm512_test_epi64_mask(difference, difference) == 0) return true;
  if (keys == nullptr) return false;
  static constexpr BytesOf k01(0, 1), k23(2, 3), k3(3, 3);
  __m512i a, b;
  take_bytes(words, _mm512_load_si512(k01.at), a, b);
  _mm512_store_si512(keys->bytes[0], a);
  _mm512_store_si512(keys->bytes[1], b);
  take_bytes(words, _mm512_load_si512(k23.at), a, b);
  _mm512_store_si512(keys->bytes[2], a);
  _mm512_store_si512(keys->bytes[3], b);
  for (uint32_t which = 0; which < 2; ++which) {
    const __m512i multiplier = _mm512_set1_epi32(static_cast<int>(BlockKeys::kMultipliers[which]));
    __m512i products[4];
    for (uint32_t i = 0; i < 4; ++i) products[i] = _mm512_mullo_epi32(words[i], multiplier);
    take_bytes(products, _mm512_load_si512(k3.at), a, b);
    _mm512_store_si512(keys->buckets[which], a);
  }
  return false;
}

/// Zero bytes where the colour in `slots` is that of the pixel.
TILEPRESS_VBMI_INLINE __m512i difference(const BlockKeys& keys, const SlotTable& table, __m512i slots) {
  // What an empty bucket holds has its top bit set.
  __m512i sum = _mm512_and_si512(slots, _mm512_set1_epi8(static_cast<char>(SlotTable::kEmpty)));
  for (uint32_t c = 0; c < 4; ++c) {
    const __m512i color = _mm512_permutexvar_epi8(slots, _mm512_load_si512(table.bytes[c]));
    sum = _mm512_ternarylogic_epi64(sum, color, _mm512_load_si512(keys.bytes[c]), 0xF6);  // sum | color ^ key
  }
  return sum;
}

struct Slots {
  __m512i slots;
  __mmask64 known;
};

TILEPRESS_VBMI_INLINE Slots find(const BlockKeys& keys, const SlotTable& table) {
  __m512i candidates[2];
  __mmask64 known[2];
  for (uint32_t which = 0; which < 2; ++which) {
    candidates[which] = _mm512_permutex2var_epi8(
        _mm512_load_si512(table.buckets[which]), _mm512_load_si512(keys.buckets[which]),
        _mm512_load_si512(table.buckets[which] + SlotTable::kBuckets / 2));
    const __m512i differs = difference(keys, table, candidates[which]);
    known[which] = _mm512_testn_epi8_mask(differs, differs);
  }
  __m512i slots = _mm512_mask_mov_epi8(_mm512_set1_epi8(SlotTable::kAbsent), known[0], candidates[0]);
  slots = _mm512_mask_mov_epi8(slots, known[1], candidates[1]);
  __mmask64 all = known[0] | known[1];
  for (uint64_t left = table.stashed; __builtin_expect(left != 0, 0); left &= left - 1) {
    const auto slot = _mm512_set1_epi8(static_cast<char>(__builtin_ctzll(left)));
    const __m512i differs = difference(keys, table, slot);
    const __mmask64 here = _mm512_testn_epi8_mask(differs, differs);
    slots = _mm512_mask_mov_epi8(slots, here, slot);
    all |= here;
  }
  return {slots, all};
}

TILEPRESS_VBMI FoundSlots find_slots(const BlockKeys& keys, const SlotTable& table, uint8_t* slots) {
  const Slots found = find(keys, table);
  _mm512_storeu_si512(slots, found.slots);
  static constexpr struct Before {
    alignas(64) uint8_t at[64];
    constexpr Before() : at() {
      for (uint32_t i = 1; i < 64; ++i) at[i] = static_cast<uint8_t>(i - 1);
    }
  } kBefore;
  const __m512i before = _mm512_permutexvar_epi8(_mm512_load_si512(kBefore.at), found.slots);
  return {found.known, _mm512_cmpneq_epi8_mask(found.slots, before) | 1};
}

TILEPRESS_VBMI void index_slots(const BlockKeys& keys, const SlotTable& table, uint16_t* indices,
                                uint8_t* widths) {
  const Slots found = find(keys, table);
  const __m512i none = _mm512_set1_epi16(-1);
  const auto store = [&](uint32_t half) TILEPRESS_VBMI {
    const __m256i slots = half == 0 ? _mm512_castsi512_si256(found.slots)
                                    : _mm512_extracti64x4_epi64(found.slots, 1);
    _mm512_storeu_si512(indices + 32 * half,
                        _mm512_mask_cvtepu8_epi16(none, static_cast<__mmask32>(found.known >> 32 * half), slots));
  };
  store(0);
  store(1);
  static constexpr struct Widths {
    alignas(64) uint8_t of[64];
    constexpr Widths() : of() {
      for (uint32_t i = 0, width = 0; i < 64; ++i) {
        if (i == 1u << width) ++width;
        of[i] = static_cast<uint8_t>(width);
      }
    }
  } kWidths;
  __m512i largest = _mm512_max_epu8(found.slots, _mm512_rol_epi32(found.slots, 8));
  largest = _mm512_max_epu8(largest, _mm512_rol_epi32(largest, 16));
  const __mmask64 raw = _mm512_test_epi8_mask(largest, _mm512_set1_epi8(SlotTable::kAbsent));
  const __m512i width = _mm512_mask_mov_epi8(
      _mm512_permutexvar_epi8(largest, _mm512_load_si512(kWidths.of)), raw, none);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(widths), _mm512_cvtepi32_epi8(width));
}

}  // namespace

const Kernels* byte_permute_kernels(const Kernels& base) {
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx512vbmi") || !__builtin_cpu_supports("avx512vbmi2") ||
      !__builtin_cpu_supports("bmi2"))
    return nullptr;
  static const Kernels kSet = [&] {
    Kernels set = base;
    set.name = "avx512vbmi";
    set.finds_slots = true;
    set.load_traversal = load_traversal;
    set.find_slots = find_slots;
    set.index_slots = index_slots;
    return set;
  }();
  return &kSet;
}

}  // namespace tilepress
#else
namespace tilepress {
const Kernels* byte_permute_kernels(const Kernels&) {
  return nullptr;
}
}  // namespace tilepress
#endif
