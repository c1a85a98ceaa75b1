// Highway kernels: the same loops, compiled once per instruction set.
#include "simd/kernel_sets.h"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)  // nothing to gain over their neighbours
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd/kernels_highway.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "simd/kernels_highway_layout.h"
#include "simd/kernels_highway_ras.h"
#include "simd/replace_words.h"
#include "tilepress/block.h"
#include "tilepress/scheme.h"

// The baseline without SIMD is what kernels_scalar.cpp is for.
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
HWY_BEFORE_NAMESPACE();
namespace tilepress {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<uint32_t, 16>;

/// Bit i: lane i of the mask.
template <class M>
HWY_INLINE uint64_t BitsOf(const Words& d, M mask) {
  uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  uint64_t bits;
  __builtin_memcpy(&bits, bytes, 8);
  return bits;
}

/// The mask of the lowest bits, one a lane.
HWY_INLINE auto MaskOf(const Words& d, uint64_t bits) {
  bits &= (uint64_t{1} << hn::Lanes(d)) - 1;
  uint8_t bytes[8];
  __builtin_memcpy(bytes, &bits, 8);
  return hn::LoadMaskBits(d, bytes);
}

/// Takes the indices of a block, some lanes at a time in order, and knows the widths of its sub-blocks.
class Indices {
 public:
  template <class V>
  HWY_INLINE void Put(size_t i, V index, uint16_t* HWY_RESTRICT indices) {
    const Words d;
    const hn::RebindToSigned<Words> di;
    const hn::Rebind<uint16_t, Words> d16;
    hn::StoreU(hn::DemoteTo(d16, hn::BitCast(di, index)), d16, indices + i);
    const auto pair = hn::Max(index, hn::Shuffle2301(index));
    hn::StoreU(hn::Max(pair, hn::Shuffle1032(pair)), d, largest_ + i);
  }
  HWY_INLINE void Widths(uint8_t* HWY_RESTRICT widths) const {
    const Words d;
    const hn::RebindToSigned<Words> di;
    const hn::Rebind<uint8_t, Words> d8;
    const hn::RebindToFloat<Words> df;
    const size_t lanes = hn::Lanes(d);
    for (size_t sub = 0; sub < kSubBlocks; sub += lanes) {
      const uint32_t* at = largest_ + sub * kSubBlockPixels;  // the four of a sub-block are alike
      const auto lower = hn::ConcatEven(d, hn::LoadU(d, at + lanes), hn::LoadU(d, at));
      const auto upper = hn::ConcatEven(d, hn::LoadU(d, at + 3 * lanes), hn::LoadU(d, at + 2 * lanes));
      const auto largest = hn::BitCast(di, hn::ConcatEven(d, upper, lower));
      // The exponent of a positive integer as a float is its bit width - 1 + 127; that of 0 is 0.
      const auto exponent = hn::ShiftRight<23>(hn::BitCast(di, hn::ConvertTo(df, largest)));
      const auto width = hn::Max(hn::Sub(exponent, hn::Set(di, 126)), hn::Zero(di));
      const auto absent = hn::Eq(largest, hn::Set(di, kNotInCcd));
      hn::StoreU(hn::DemoteTo(d8, hn::IfThenElse(absent, hn::Set(di, kRawWidth), width)), d8, widths + sub);
    }
  }

 private:
  HWY_ALIGN uint32_t largest_[kLanes];
};

void Find(const uint32_t* HWY_RESTRICT pixels, const ProbeTable& table, uint16_t* HWY_RESTRICT indices,
          uint8_t* HWY_RESTRICT widths) {
  const Words d;
  const hn::RebindToSigned<Words> di;
  const auto none = hn::Set(d, kNotInCcd), multiplier = hn::Set(d, table.multiplier);
  Indices out;
  for (size_t i = 0; i < kLanes; i += hn::Lanes(d)) {
    const auto color = hn::LoadU(d, pixels + i);
    const auto at =
        hn::BitCast(di, hn::ShiftRightSame(hn::Mul(color, multiplier), static_cast<int>(table.shift)));
    const auto key = hn::GatherIndex(d, table.colors.data(), at);
    const auto known = hn::Eq(key, color);
    auto value = none;
    if (!hn::AllFalse(d, known))
      value = hn::IfThenElse(known, hn::GatherIndex(d, table.values.data(), at), none);
    out.Put(i, value, indices);
  }
  out.Widths(widths);
}

uint64_t PlacesOf(const uint32_t* HWY_RESTRICT pixels, uint32_t color) {
  const Words d;
  const auto wanted = hn::Set(d, color);
  uint64_t places = 0;
  for (size_t i = 0; i < kLanes; i += hn::Lanes(d))
    places |= BitsOf(d, hn::Eq(hn::LoadU(d, pixels + i), wanted)) << i;
  return places;
}

bool Split(const uint32_t* HWY_RESTRICT pixels, FewColors& out) {
  uint32_t count = 0, covered = 0;
  for (uint64_t left = ~uint64_t{0}; left != 0; ++count) {
    if (count == FewColors::kMost || covered < count * FewColors::kPixelsPerColor) return false;
    const uint32_t color = pixels[__builtin_ctzll(left)];
    const uint64_t places = PlacesOf(pixels, color);
    out.colors[count] = color;
    out.places[count] = places;
    left &= ~places;
    covered = kLanes - static_cast<uint32_t>(__builtin_popcountll(left));
  }
  out.count = count;
  return true;
}

void FindFew(const uint32_t* HWY_RESTRICT pixels, const FewColors& few,
             const uint32_t* HWY_RESTRICT few_values, uint16_t* HWY_RESTRICT indices,
             uint8_t* HWY_RESTRICT widths) {
  const Words d;
  Indices out;
  for (size_t i = 0; i < kLanes; i += hn::Lanes(d)) {
    const auto color = hn::LoadU(d, pixels + i);
    auto value = hn::Set(d, few_values[0]);
    for (uint32_t n = 1; n < few.count; ++n)
      value = hn::IfThenElse(hn::Eq(color, hn::Set(d, few.colors[n])), hn::Set(d, few_values[n]), value);
    out.Put(i, value, indices);
  }
  out.Widths(widths);
}

void Pack(const uint16_t* HWY_RESTRICT indices, const uint8_t* HWY_RESTRICT widths,
          uint32_t* HWY_RESTRICT packed) {
  const hn::Full128<uint32_t> d;
  const hn::Rebind<uint16_t, decltype(d)> d16;
  struct Factors {
    HWY_ALIGN uint32_t of[9][4] = {};
    constexpr Factors() {
      for (uint32_t width = 0; width < 9; ++width)
        for (uint32_t i = 0; i < 4; ++i) of[width][i] = 1u << (3 - i) * width;
    }
  };
  static constexpr Factors kFactors;
  for (uint32_t sub = 0; sub < kSubBlocks; ++sub) {
    const uint32_t width = widths[sub] <= 8 ? widths[sub] : 0;
    const auto index = hn::PromoteTo(d, hn::LoadU(d16, indices + sub * kSubBlockPixels));
    const auto placed = hn::Mul(index, hn::Load(d, kFactors.of[width]));
    const auto pairs = hn::Or(placed, hn::Shuffle2301(placed));
    packed[sub] = hn::GetLane(hn::Or(pairs, hn::Shuffle1032(pairs)));
  }
}

uint32_t CountUpTo(const uint8_t* HWY_RESTRICT widths, uint32_t limit) {
  const hn::Full128<uint8_t> d;
  const auto width = hn::LoadU(d, widths), bound = hn::Set(d, static_cast<uint8_t>(limit));
  return static_cast<uint32_t>(hn::CountTrue(d, hn::Eq(hn::Max(width, bound), bound)));
}

uint64_t Members(const uint32_t* HWY_RESTRICT pixels, const ProbeTable& table,
                 const uint32_t* HWY_RESTRICT crowded_colors, uint32_t crowded,
                 uint32_t* HWY_RESTRICT places) {
  const Words d;
  const hn::RebindToSigned<Words> di;
  const uint32_t size = table.size();
  const auto outside = hn::Set(d, size), multiplier = hn::Set(d, table.multiplier);
  uint64_t mask = 0;
  for (size_t i = 0; i < kLanes; i += hn::Lanes(d)) {
    const auto color = hn::LoadU(d, pixels + i);
    const auto at = hn::ShiftRightSame(hn::Mul(color, multiplier), static_cast<int>(table.shift));
    const auto key = hn::GatherIndex(d, table.colors.data(), hn::BitCast(di, at));
    auto place = hn::IfThenElse(hn::Eq(key, color), at, outside);
    for (uint32_t c = 0; c < crowded; ++c)
      place = hn::IfThenElse(hn::Eq(color, hn::Set(d, crowded_colors[c])), hn::Set(d, size + 1 + c), place);
    hn::StoreU(place, d, places + i);
    mask |= BitsOf(d, hn::Ne(place, outside)) << i;
  }
  return mask;
}

Smallest FindSmallest(const uint32_t* HWY_RESTRICT counts, uint32_t stride) {
  const Words d;
  HWY_ALIGN uint32_t sums[kLanes];
  auto smallest = hn::Set(d, ~0u);
  for (size_t i = 0; i < kLanes; i += hn::Lanes(d)) {
    auto sum = hn::LoadU(d, counts + i);
    for (size_t n = 1; n < 4; ++n) sum = hn::Add(sum, hn::LoadU(d, counts + i + n * stride));
    hn::Store(sum, d, sums + i);
    smallest = hn::Min(smallest, sum);
  }
  Smallest found;
  found.smallest = hn::GetLane(hn::MinOfLanes(d, smallest));
  const uint64_t places = PlacesOf(sums, found.smallest);
  found.at = static_cast<uint32_t>(__builtin_ctzll(places));
  found.second = found.smallest;
  if ((places & (places - 1)) != 0) return found;
  sums[found.at] = ~0u;
  smallest = hn::Set(d, ~0u);
  for (size_t i = 0; i < kLanes; i += hn::Lanes(d)) smallest = hn::Min(smallest, hn::Load(d, sums + i));
  found.second = hn::GetLane(hn::MinOfLanes(d, smallest));
  return found;
}

uint64_t Compact(const uint32_t* HWY_RESTRICT pixels, uint64_t mask, uint32_t before,
                 uint32_t* HWY_RESTRICT out) {
  const Words d;
  uint32_t count = 0;
  for (size_t i = 0; i < kLanes; i += hn::Lanes(d)) {
    hn::StoreU(hn::Compress(hn::LoadU(d, pixels + i), MaskOf(d, mask >> i)), d, out + count);
    count += static_cast<uint32_t>(__builtin_popcountll(mask >> i & ((uint64_t{1} << hn::Lanes(d)) - 1)));
  }
  if (count == 0) return 0;
  uint64_t alike = out[0] == before;
  for (size_t i = 1; i < count; i += hn::Lanes(d)) {
    alike |= BitsOf(d, hn::Eq(hn::LoadU(d, out + i), hn::LoadU(d, out + i - 1))) << i;
  }
  return count == 64 ? alike : alike & ((uint64_t{1} << count) - 1);
}

uint64_t RunBegins(const uint32_t* HWY_RESTRICT pixels) {
  const Words d;
  uint64_t begins = 0;
  for (size_t i = 0; i < kLanes; i += hn::Lanes(d)) {
    const auto now = hn::LoadU(d, pixels + i);
    if (i > 0)
      begins |= BitsOf(d, hn::Ne(now, hn::LoadU(d, pixels + i - 1))) << i;
    else  // from the comparison with the pixels behind
      begins =
          (BitsOf(d, hn::Ne(now, hn::LoadU(d, pixels + 1))) << 1 | 1) & ((uint64_t{1} << hn::Lanes(d)) - 1);
  }
  return begins;
}

uint64_t CountRuns(const uint32_t* HWY_RESTRICT pixels, uint64_t begins, uint32_t end,
                   ColorBucket* HWY_RESTRICT table, size_t buckets) {
  const hn::CappedTag<uint32_t, ColorBucket::kPlaces> d;
  uint64_t others = 0;
  while (begins != 0) {
    const auto first = static_cast<uint32_t>(__builtin_ctzll(begins));
    begins &= begins - 1;
    const uint32_t next = begins != 0 ? static_cast<uint32_t>(__builtin_ctzll(begins)) : end;
    ColorBucket& bucket = table[ColorBucket::of(pixels[first], buckets)];
    const auto wanted = hn::Set(d, pixels[first]);
    intptr_t place = -1;
    for (size_t i = 0; i < ColorBucket::kPlaces && place < 0; i += hn::Lanes(d)) {
      place = hn::FindFirstTrue(d, hn::Eq(hn::Load(d, bucket.colors + i), wanted));
      if (place >= 0) place += static_cast<intptr_t>(i);
    }
    if (place >= 0)
      bucket.counts[place] += next - first;
    else
      others |= uint64_t{1} << first;
  }
  return others;
}

uint32_t ReplaceRow(const std::byte* words, uint32_t count, bool swap_red_blue, uint32_t set_bits,
                    uint32_t* row, uint8_t* changed_blocks) {
  const Words d;
  const auto bits = hn::Set(d, set_bits), kept = hn::Set(d, 0xFF00FF00u);
  const auto lanes = static_cast<uint32_t>(hn::Lanes(d));
  const auto vector_at = [&](size_t x) HWY_ATTR {
    const auto word = hn::LoadU(d, reinterpret_cast<const uint32_t*>(words) + x);
    if (!swap_red_blue) return hn::Or(word, bits);
    return hn::Or(hn::Or(hn::And(word, kept), hn::AndNot(kept, hn::RotateRight<16>(word))), bits);
  };
  uint32_t changed = 0, x = 0;
  for (; x + lanes <= count; x += lanes) {
    const auto word = vector_at(x);
    const auto differs = hn::Ne(word, hn::LoadU(d, row + x));
    if (hn::AllFalse(d, differs)) continue;  // what stays is not written again
    hn::StoreU(word, d, row + x);
    const uint64_t places = BitsOf(d, differs);
    changed += static_cast<uint32_t>(__builtin_popcountll(places));
    if (changed_blocks == nullptr) continue;
    for (uint32_t lane = 0; lane < lanes; lane += 8)
      changed_blocks[(x + lane) / 8] |= static_cast<uint8_t>(places >> lane);
  }
  return changed + replace_words(words, x, count, swap_red_blue, set_bits, row, changed_blocks);
}

const Kernels& Set(const char* name) {
  static const Kernels kSet = {
      .name = name,
      .byte_permutes = false,
      .load_traversal = LoadTraversal,
      .load_slots = load_slots_plainly,
      .solid_blocks = SolidBlocks,
      .find = Find,
      .find_slots = find_slots_plainly,
      .count_slots = count_slots_plainly,
      .index_slots = index_slots_plainly,
      .places_of = PlacesOf,
      .split = Split,
      .find_few = FindFew,
      .pack = Pack,
      .write_sub_blocks = write_sub_blocks_plainly,
      .read_indices = read_indices_plainly,
      .read_raw = ReadRaw,
      .code_sum = code_sum_plainly,
      .count_up_to = CountUpTo,
      .members = Members,
      .find_smallest = FindSmallest,
      .compact = Compact,
      .run_begins = RunBegins,
      .count_runs = CountRuns,
      .ras_code_bits = RasCodeBits,
      .ras_groups = WriteRasGroups,
      .replace_row = ReplaceRow,
      .ras_restore = RestoreRasSamples,
      .narrow_bytes = NarrowBytes,
      .widen_bytes = WidenBytes,
  };
  return kSet;
}

}  // namespace HWY_NAMESPACE
}  // namespace tilepress
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace tilepress {

// Chosen here and not by Highway's own dispatcher, which lives in a shared library: the engine inside other
// people's programs must not bring libraries along.
std::vector<const Kernels*> highway_kernels() {
  std::vector<const Kernels*> sets;
#if HWY_ARCH_X86
  __builtin_cpu_init();
#if HWY_TARGETS & HWY_AVX3
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512cd")) {
    if (const Kernels* better = byte_permute_kernels(N_AVX3::Set("avx512")); better != nullptr)
      sets.push_back(better);
    sets.push_back(&N_AVX3::Set("avx512"));
  }
#endif
#if HWY_TARGETS & HWY_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    sets.push_back(&N_AVX2::Set("avx2"));
#endif
#if HWY_TARGETS & HWY_SSE4
  if (__builtin_cpu_supports("sse4.1") && __builtin_cpu_supports("sse4.2"))
    sets.push_back(&N_SSE4::Set("sse4"));
#endif
#elif HWY_ARCH_ARM_A64
  sets.push_back(&N_NEON::Set("neon"));
#endif
  return sets;
}

}  // namespace tilepress
#endif
