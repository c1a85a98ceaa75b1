// Probe kernels by Highway.
#include "cpu/highway_targets.h"
#include "dcp/index_widths.h"
#include "dcp/probe_kernels.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "dcp/probe_kernels_highway.cpp"
#include "hwy/foreach_target.h"  // before Highway's other headers

#include "cpu/highway.h"

#if TILEPRESS_HAS_SIMD
TILEPRESS_HIGHWAY_BEGIN

/// Takes the indices of a block in order, some lanes at a time, and returns the widths of its sub-blocks.
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
  HWY_ALIGN uint32_t largest_[kBlockPixels];
};

void Find(const uint32_t* HWY_RESTRICT pixels, const ProbeTable& table, uint16_t* HWY_RESTRICT indices,
          uint8_t* HWY_RESTRICT widths) {
  const Words d;
  const hn::RebindToSigned<Words> di;
  const auto none = hn::Set(d, kNotInCcd), multiplier = hn::Set(d, table.multiplier);
  Indices out;
  for (size_t i = 0; i < kBlockPixels; i += hn::Lanes(d)) {
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

void FindFew(const uint32_t* HWY_RESTRICT pixels, const FewColors& few,
             const uint32_t* HWY_RESTRICT few_values, uint16_t* HWY_RESTRICT indices,
             uint8_t* HWY_RESTRICT widths) {
  const Words d;
  Indices out;
  for (size_t i = 0; i < kBlockPixels; i += hn::Lanes(d)) {
    const auto color = hn::LoadU(d, pixels + i);
    auto value = hn::Set(d, few_values[0]);
    for (uint32_t n = 1; n < few.count; ++n)
      value = hn::IfThenElse(hn::Eq(color, hn::Set(d, few.colors[n])), hn::Set(d, few_values[n]), value);
    out.Put(i, value, indices);
  }
  out.Widths(widths);
}

uint64_t Members(const uint32_t* HWY_RESTRICT pixels, const ProbeTable& table,
                 const uint32_t* HWY_RESTRICT crowded_colors, uint32_t crowded,
                 uint32_t* HWY_RESTRICT places) {
  const Words d;
  const hn::RebindToSigned<Words> di;
  const uint32_t size = table.size();
  const auto outside = hn::Set(d, size), multiplier = hn::Set(d, table.multiplier);
  uint64_t mask = 0;
  for (size_t i = 0; i < kBlockPixels; i += hn::Lanes(d)) {
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
  HWY_ALIGN uint32_t sums[kBlockPixels];
  auto smallest = hn::Set(d, ~0u);
  for (size_t i = 0; i < kBlockPixels; i += hn::Lanes(d)) {
    auto sum = hn::LoadU(d, counts + i);
    for (size_t n = 1; n < 4; ++n) sum = hn::Add(sum, hn::LoadU(d, counts + i + n * stride));
    hn::Store(sum, d, sums + i);
    smallest = hn::Min(smallest, sum);
  }
  Smallest found;
  found.smallest = hn::GetLane(hn::MinOfLanes(d, smallest));
  const uint64_t places = PlacesIn(sums, found.smallest);
  found.at = static_cast<uint32_t>(__builtin_ctzll(places));
  found.second = found.smallest;
  if ((places & (places - 1)) != 0) return found;
  sums[found.at] = ~0u;
  smallest = hn::Set(d, ~0u);
  for (size_t i = 0; i < kBlockPixels; i += hn::Lanes(d)) smallest = hn::Min(smallest, hn::Load(d, sums + i));
  found.second = hn::GetLane(hn::MinOfLanes(d, smallest));
  return found;
}

#if HWY_TARGET == HWY_AVX3
constexpr auto kCompact = compact_by_avx512;
#else
constexpr auto kCompact = compact_plainly;
#endif

constexpr ProbeKernels kProbeKernels = {.find = Find,
                                        .find_few = FindFew,
                                        .members = Members,
                                        .find_smallest = FindSmallest,
                                        .compact = kCompact};

TILEPRESS_HIGHWAY_END
#endif

#if HWY_ONCE
namespace tilepress {

constexpr KernelSets<ProbeKernels> kProbeKernelSets = TILEPRESS_KERNEL_SETS(
    kPlainProbeKernels, kProbeKernels, TILEPRESS_AVX512_OR(kPlainProbeKernels, kProbeKernels));

}  // namespace tilepress
#endif
