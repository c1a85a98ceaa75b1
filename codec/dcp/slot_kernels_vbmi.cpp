// Slot kernels by AVX-512 VBMI: a register of 64 or 128 bytes serves as a table.
#include "dcp/slot_kernels.h"

#if defined(__x86_64__)
#include "cpu/vbmi.h"
#include "dcp/slot_table.h"

namespace tilepress {
namespace {

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

/// Takes two bytes of each of 64 pixels: 64 bytes `low` and 64 bytes `high`, as the positions `which` select.
TILEPRESS_VBMI_INLINE void take_bytes(const BlockWords& words, __m512i which, __m512i& low, __m512i& high) {
  const __m512i first = _mm512_permutex2var_epi8(words.of[0], which, words.of[1]);
  const __m512i second = _mm512_permutex2var_epi8(words.of[2], which, words.of[3]);
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

/// SlotBuckets::kMasks as bit matrices: byte 7 - i has the mask of bit i of the result.
struct BucketMatrices {
  uint64_t of[2][4];
  constexpr BucketMatrices() : of() {
    for (uint32_t which = 0; which < 2; ++which)
      for (uint32_t c = 0; c < 4; ++c)
        for (uint32_t bit = 0; bit < 7; ++bit)
          of[which][c] |= uint64_t{SlotBuckets::kMasks[which][bit] >> 8 * c & 0xFF} << 8 * (7 - bit);
  }
};

/// The bytes of a block's pixels, and the two buckets of each pixel.
struct Keys {
  __m512i bytes[4];  ///< byte c of each pixel
  __m512i buckets[2];
};

TILEPRESS_VBMI_INLINE Keys keys_of(const BlockWords& words) {
  static constexpr BytesOf k01(0, 1), k23(2, 3);
  static constexpr BucketMatrices kMatrices;
  Keys keys;
  take_bytes(words, _mm512_load_si512(k01.at), keys.bytes[0], keys.bytes[1]);
  take_bytes(words, _mm512_load_si512(k23.at), keys.bytes[2], keys.bytes[3]);
  for (uint32_t which = 0; which < 2; ++which) {
    __m512i parts[4];
    for (uint32_t c = 0; c < 4; ++c) {
      const __m512i matrix = _mm512_set1_epi64(static_cast<long long>(kMatrices.of[which][c]));
      parts[c] = _mm512_gf2p8affine_epi64_epi8(keys.bytes[c], matrix, 0);
    }
    const __m512i three = _mm512_ternarylogic_epi64(parts[0], parts[1], parts[2], 0x96);  // exclusive or
    keys.buckets[which] = _mm512_xor_si512(three, parts[3]);
  }
  return keys;
}

/// Compares bytes `begin` to `end` of each pixel with the colour of its slot. A byte of the result is 0 if
/// they are equal and the byte of `sum` is 0.
TILEPRESS_VBMI_INLINE __m512i difference(const Keys& keys, const SlotTable& table, __m512i slots,
                                         uint32_t begin, uint32_t end, __m512i sum) {
  for (uint32_t c = begin; c < end; ++c) {
    const __m512i color = _mm512_permutexvar_epi8(slots, _mm512_load_si512(table.bytes[c]));
    sum = _mm512_ternarylogic_epi64(sum, color, keys.bytes[c], 0xF6);  // sum | color ^ key
  }
  return sum;
}

struct Slots {
  __m512i slots;
  __mmask64 known;
};

TILEPRESS_VBMI_INLINE Slots find(const Keys& keys, const SlotTable& table) {
  __m512i candidates[2], differs[2];
  __mmask64 known[2];
  for (uint32_t which = 0; which < 2; ++which) {
    candidates[which] =
        _mm512_permutex2var_epi8(_mm512_load_si512(table.buckets[which]), keys.buckets[which],
                                 _mm512_load_si512(table.buckets[which] + SlotTable::kBuckets / 2));
    // An empty bucket has its top bit set.
    const __m512i empty =
        _mm512_and_si512(candidates[which], _mm512_set1_epi8(static_cast<char>(SlotTable::kEmpty)));
    differs[which] = difference(keys, table, candidates[which], 0, 1, empty);
    known[which] = _mm512_testn_epi8_mask(differs[which], differs[which]);
  }
  if ((known[0] | known[1] | table.stashed) == 0) return {_mm512_set1_epi8(SlotTable::kAbsent), 0};
  for (uint32_t which = 0; which < 2; ++which) {
    differs[which] = difference(keys, table, candidates[which], 1, 4, differs[which]);
    known[which] = _mm512_testn_epi8_mask(differs[which], differs[which]);
  }
  __m512i slots = _mm512_mask_mov_epi8(_mm512_set1_epi8(SlotTable::kAbsent), known[0], candidates[0]);
  slots = _mm512_mask_mov_epi8(slots, known[1], candidates[1]);
  __mmask64 all = known[0] | known[1];
  for (uint64_t left = table.stashed; __builtin_expect(left != 0, 0); left &= left - 1) {
    const auto slot = _mm512_set1_epi8(static_cast<char>(__builtin_ctzll(left)));
    const __m512i differ = difference(keys, table, slot, 0, 4, _mm512_setzero_si512());
    const __mmask64 here = _mm512_testn_epi8_mask(differ, differ);
    slots = _mm512_mask_mov_epi8(slots, here, slot);
    all |= here;
  }
  return {slots, all};
}

TILEPRESS_VBMI_INLINE FoundSlots find_slots(const BlockWords& words, const Keys& keys, const SlotTable& table,
                                            uint8_t* slots) {
  const Slots found = find(keys, table);
  _mm512_storeu_si512(slots, found.slots);
  if (found.known == 0) return {0, run_begins(words)};
  static constexpr struct Before {
    alignas(64) uint8_t at[64];
    constexpr Before() : at() {
      for (uint32_t i = 1; i < 64; ++i) at[i] = static_cast<uint8_t>(i - 1);
    }
  } kBefore;
  const __m512i before = _mm512_permutexvar_epi8(_mm512_load_si512(kBefore.at), found.slots);
  return {found.known, _mm512_cmpneq_epi8_mask(found.slots, before) | 1};
}

TILEPRESS_VBMI uint64_t count_slots(const uint8_t* slots, uint64_t wanted, uint32_t* counts) {
  const __m512i all = _mm512_loadu_si512(slots);
  for (uint32_t n = 0; n < 4 && wanted != 0; ++n) {
    const uint8_t slot = slots[__builtin_ctzll(wanted)];
    const uint64_t places = wanted & _mm512_cmpeq_epi8_mask(all, _mm512_set1_epi8(static_cast<char>(slot)));
    counts[slot] += static_cast<uint32_t>(__builtin_popcountll(places));
    wanted &= ~places;
  }
  return wanted;
}

TILEPRESS_VBMI_INLINE void index_slots(const Keys& keys, const SlotTable& table, uint16_t* indices,
                                       uint8_t* widths) {
  const Slots found = find(keys, table);
  const __m512i none = _mm512_set1_epi16(-1);
  const auto store = [&](uint32_t half) TILEPRESS_VBMI {
    const __m256i slots =
        half == 0 ? _mm512_castsi512_si256(found.slots) : _mm512_extracti64x4_epi64(found.slots, 1);
    _mm512_storeu_si512(
        indices + 32 * half,
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
  const __m512i width =
      _mm512_mask_mov_epi8(_mm512_permutexvar_epi8(largest, _mm512_load_si512(kWidths.of)), raw, none);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(widths), _mm512_cvtepi32_epi8(width));
}

TILEPRESS_VBMI FoundSlots find_slots(const uint32_t* pixels, const SlotTable& table, uint8_t* slots) {
  const BlockWords words = words_of(pixels);
  return find_slots(words, keys_of(words), table, slots);
}

TILEPRESS_VBMI void index_slots(const uint32_t* pixels, const SlotTable& table, uint16_t* indices,
                                uint8_t* widths) {
  index_slots(keys_of(words_of(pixels)), table, indices, widths);
}

TILEPRESS_VBMI bool load_slots(const uint32_t* top_left, uint32_t stride, uint32_t* pixels,
                               const SlotLookups& lookups) {
  BlockWords words;
  if (load(top_left, stride, pixels, words)) return true;
  if (lookups.empty()) return false;
  const Keys keys = keys_of(words);
  for (const IndexLookup& each : lookups.dictionaries)
    index_slots(keys, *each.table, each.indices, each.widths);
  for (MemberLookup* each : lookups.members) each->found = find_slots(words, keys, *each->table, each->slots);
  return false;
}

}  // namespace

constexpr SlotKernels kVbmiSlotKernels = {.byte_permutes = true,
                                          .load = load_slots,
                                          .find = find_slots,
                                          .count = count_slots,
                                          .index = index_slots};

}  // namespace tilepress
#endif
