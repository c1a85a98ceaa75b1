// RAS kernels by Highway.
#include "cpu/highway_targets.h"
#include "ras/ras_kernels.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ras/ras_kernels_highway.cpp"
#include "hwy/foreach_target.h"  // before Highway's other headers

#include "cpu/highway.h"

#if TILEPRESS_HAS_SIMD
TILEPRESS_HIGHWAY_BEGIN

using Samples = hn::CappedTag<int16_t, 32>;  // a row of eight pixels of four planes

template <class V>
HWY_INLINE V FoldedResidual(const Samples& d, const int16_t* at, V) {
  const auto a = hn::LoadU(d, at - 4), b = hn::LoadU(d, at - kRasRowSamples);
  const auto c = hn::LoadU(d, at - kRasRowSamples - 4);
  const auto gradient = hn::Sub(hn::Add(a, b), c);
  const auto prediction = hn::Max(hn::Min(a, b), hn::Min(hn::Max(a, b), gradient));
  const auto e = hn::Sub(hn::LoadU(d, at), prediction);
  return hn::Xor(hn::Add(e, e), hn::ShiftRight<15>(e));
}

template <int kK, class V>
HWY_INLINE V GroupBits(const Samples& d, V u0, V u1, V u2, V u3, V residuals) {
  const auto high = hn::Add(hn::Add(hn::ShiftRight<kK>(u0), hn::ShiftRight<kK>(u1)),
                            hn::Add(hn::ShiftRight<kK>(u2), hn::ShiftRight<kK>(u3)));
  // residuals · (1 + k) by additions
  auto fixed = hn::Set(d, 3);
  for (int i = 0; i <= kK; ++i) fixed = hn::Add(fixed, residuals);
  return hn::Add(high, fixed);
}

/// Sets k to kK for the groups that take fewer bits with kK.
template <int kK, class V>
HWY_INLINE void TryK(const Samples& d, V u0, V u1, V u2, V u3, V residuals, V& bits, V& k) {
  const auto candidate = GroupBits<kK>(d, u0, u1, u2, u3, residuals);
  k = hn::IfThenElse(hn::Lt(candidate, bits), hn::Set(d, kK), k);
  bits = hn::Min(candidate, bits);
}

/// Returns the bits of groups, headers included, and their k.
template <class V>
HWY_INLINE void ChooseCode(const Samples& d, V u0, V u1, V u2, V u3, V residuals, V& bits, V& k) {
  bits = GroupBits<0>(d, u0, u1, u2, u3, residuals);
  k = hn::Zero(d);
  TryK<1>(d, u0, u1, u2, u3, residuals, bits, k);
  TryK<2>(d, u0, u1, u2, u3, residuals, bits, k);
  TryK<3>(d, u0, u1, u2, u3, residuals, bits, k);
  TryK<4>(d, u0, u1, u2, u3, residuals, bits, k);
  TryK<5>(d, u0, u1, u2, u3, residuals, bits, k);
  TryK<6>(d, u0, u1, u2, u3, residuals, bits, k);
  const auto zero = hn::Eq(hn::Or(hn::Or(u0, u1), hn::Or(u2, u3)), hn::Zero(d));
  bits = hn::IfThenElse(zero, hn::Set(d, 3), bits);
  k = hn::IfThenElse(zero, hn::Set(d, kRasZeroGroup), k);
}

/// Calls visit(number, u0, u1, u2, u3, residuals) for vectors of groups from ras_group_index `number` on,
/// with their folded residuals and the number of residuals per group.
template <class Visit>
HWY_INLINE void ForEachGroups(const int16_t* HWY_RESTRICT samples, const Visit& visit) {
  const Samples d;
  const hn::Repartition<uint64_t, Samples> d64;  // one pixel a lane
  HWY_ALIGN static constexpr int16_t kFirstGroup[32] = {3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4,
                                                        4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4};
  const auto four = hn::Set(d, 4);
  for (uint32_t half = 0; half < 8; half += 4)  // two pairs of rows at once
    for (uint32_t x = 0; x < 32; x += static_cast<uint32_t>(hn::Lanes(d))) {
      const int16_t* at = samples + ras_sample_index(0, static_cast<int32_t>(half)) + x;
      const auto row0 = FoldedResidual(d, at, four), row1 = FoldedResidual(d, at + kRasRowSamples, four);
      const auto row2 = FoldedResidual(d, at + 2 * kRasRowSamples, four);
      const auto row3 = FoldedResidual(d, at + 3 * kRasRowSamples, four);
      const auto as64 = [&](decltype(row0) v) HWY_ATTR { return hn::BitCast(d64, v); };
      // Even and odd pixels of the upper and the lower pair of rows: lane by lane the four residuals of a
      // group.
      const auto u0 = hn::BitCast(d, hn::InterleaveLower(d64, as64(row0), as64(row2)));
      const auto u1 = hn::BitCast(d, hn::InterleaveUpper(d64, as64(row0), as64(row2)));
      const auto u2 = hn::BitCast(d, hn::InterleaveLower(d64, as64(row1), as64(row3)));
      const auto u3 = hn::BitCast(d, hn::InterleaveUpper(d64, as64(row1), as64(row3)));
      visit(half * 8 + x, u0, u1, u2, u3, half == 0 && x == 0 ? hn::LoadU(d, kFirstGroup) : four);
    }
}

uint32_t CodeBits(const int16_t* HWY_RESTRICT samples) {
  const Samples d;
  using V = hn::Vec<Samples>;
  const hn::Repartition<int32_t, Samples> d32;
  auto total = hn::Zero(d32);
  ForEachGroups(samples, [&](uint32_t, V u0, V u1, V u2, V u3, V residuals) HWY_ATTR {
    V bits, k;
    ChooseCode(d, u0, u1, u2, u3, residuals, bits, k);
    // Sum pairs of 16-bit lanes into 32-bit ones; a group's bits are positive and far below 2^15.
    const auto pairs = hn::BitCast(d32, bits);
    total = hn::Add(total, hn::Add(hn::ShiftRight<16>(pairs), hn::ShiftRight<16>(hn::ShiftLeft<16>(pairs))));
  });
  return static_cast<uint32_t>(hn::GetLane(hn::SumOfLanes(d32, total)));
}

void ChooseCodes(const int16_t* HWY_RESTRICT samples, RasGroups& groups) {
  const Samples d;
  using V = hn::Vec<Samples>;
  ForEachGroups(samples, [&](uint32_t number, V u0, V u1, V u2, V u3, V residuals) HWY_ATTR {
    V bits, k;
    ChooseCode(d, u0, u1, u2, u3, residuals, bits, k);
    const auto store = [&](V v, uint16_t* to)
                           HWY_ATTR { hn::StoreU(v, d, reinterpret_cast<int16_t*>(to + number)); };
    store(u0, groups.residuals[0]);
    store(u1, groups.residuals[1]);
    store(u2, groups.residuals[2]);
    store(u3, groups.residuals[3]);
    store(k, groups.k);
  });
}

void WriteGroups(const int16_t* HWY_RESTRICT samples, RasGroups& groups) {
  ChooseCodes(samples, groups);
  using Codes = hn::CappedTag<uint64_t, 8>;
  const Codes d;
  const hn::Rebind<uint32_t, Codes> d32;
  const hn::Rebind<uint16_t, Codes> d16;
  const auto one = hn::Set(d, 1), zero_group = hn::Set(d, kRasZeroGroup);
  const auto load = [&](const uint16_t* from)
                        HWY_ATTR { return hn::PromoteTo(d, hn::PromoteTo(d32, hn::LoadU(d16, from))); };
  for (uint32_t number = 0; number < 4 * kSubBlocks; number += static_cast<uint32_t>(hn::Lanes(d))) {
    const auto k = load(groups.k + number), after = hn::Add(k, one);
    auto code = k, length = hn::Set(d, 3);
    for (uint32_t i = 0; i < 4; ++i) {
      const auto u = load(groups.residuals[i] + number), ones = hn::Shr(u, k);
      const auto high = hn::Shl(hn::Sub(hn::Shl(one, ones), one), after);
      auto bits = hn::Or(high, hn::Sub(u, hn::Shl(ones, k))), size = hn::Add(ones, after);
      if (i == 0 && number < 4) {  // the first pixel of a plane has no residual
        const auto first = hn::FirstN(d, 4 - number);
        bits = hn::IfThenZeroElse(first, bits);
        size = hn::IfThenZeroElse(first, size);
      }
      code = hn::Or(hn::Shl(code, size), bits);
      length = hn::Add(length, size);
    }
    const auto zero = hn::Eq(k, zero_group);
    hn::StoreU(hn::IfThenElse(zero, k, code), d, groups.codes + number);
    hn::StoreU(hn::IfThenElse(zero, hn::Set(d, 3), length), d, groups.lengths + number);
  }
}

void Restore(int16_t* samples) {
  const hn::CappedTag<int16_t, 4> d;  // a pixel
  constexpr int32_t kRow = 4 * kBlockSide;
  auto left = hn::LoadU(d, samples);
  for (int32_t x = 4; x < kRow; x += 4) {
    left = hn::Add(left, hn::LoadU(d, samples + x));
    hn::StoreU(left, d, samples + x);
  }
  for (int16_t* row = samples + kRow; row != samples + 4 * kBlockPixels; row += kRow) {
    auto upper_left = hn::LoadU(d, row - kRow);
    left = hn::Add(upper_left, hn::LoadU(d, row));
    hn::StoreU(left, d, row);
    for (int32_t x = 4; x < kRow; x += 4) {
      const auto upper = hn::LoadU(d, row + x - kRow);
      const auto gradient = hn::Add(hn::Sub(upper, upper_left), left);
      const auto prediction = hn::Max(hn::Min(left, upper), hn::Min(hn::Max(left, upper), gradient));
      left = hn::Add(prediction, hn::LoadU(d, row + x));
      hn::StoreU(left, d, row + x);
      upper_left = upper;
    }
  }
}

bool NarrowBytes(const int16_t* HWY_RESTRICT samples, uint32_t* HWY_RESTRICT pixels) {
  const Samples d;
  const hn::Rebind<uint8_t, Samples> d8;
  auto* bytes = reinterpret_cast<uint8_t*>(pixels);
  auto any = hn::Zero(d);
  for (size_t i = 0; i < 4 * kBlockPixels; i += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, samples + i);
    any = hn::Or(any, v);
    hn::StoreU(hn::DemoteTo(d8, v), d8, bytes + i);
  }
  return hn::AllTrue(d, hn::Eq(hn::And(any, hn::Set(d, static_cast<int16_t>(0xFF00))), hn::Zero(d)));
}

void WidenBytes(const uint32_t* HWY_RESTRICT top_left, uint32_t stride, int16_t* HWY_RESTRICT samples) {
  const Samples d;
  const hn::Rebind<uint8_t, Samples> d8;
  for (uint32_t y = 0; y < 8; ++y) {
    const auto* row = reinterpret_cast<const uint8_t*>(top_left + size_t{y} * stride);
    int16_t* out = samples + ras_sample_index(0, static_cast<int32_t>(y));
    for (size_t x = 0; x < 32; x += hn::Lanes(d))
      hn::StoreU(hn::PromoteTo(d, hn::LoadU(d8, row + x)), d, out + x);
  }
}

constexpr RasKernels kRasKernels = {.widen_bytes = WidenBytes,
                                    .code_bits = CodeBits,
                                    .groups = WriteGroups,
                                    .restore = Restore,
                                    .narrow_bytes = NarrowBytes};

TILEPRESS_HIGHWAY_END
#endif

#if HWY_ONCE
namespace tilepress {

constexpr KernelSets<RasKernels> kRasKernelSets =
    TILEPRESS_KERNEL_SETS(kPlainRasKernels, kRasKernels, TILEPRESS_AVX512_OR(kPlainRasKernels, kRasKernels));

}  // namespace tilepress
#endif
