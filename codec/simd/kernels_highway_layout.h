// Highway kernels of a block's pixels as they lie in a plane, in traversal order and raw in memory: for
// kernels_highway.cpp, which compiles this once per instruction set with the rest.
#if defined(TILEPRESS_KERNELS_HIGHWAY_LAYOUT_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef TILEPRESS_KERNELS_HIGHWAY_LAYOUT_H
#undef TILEPRESS_KERNELS_HIGHWAY_LAYOUT_H
#else
#define TILEPRESS_KERNELS_HIGHWAY_LAYOUT_H
#endif

#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
HWY_BEFORE_NAMESPACE();
namespace tilepress {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

bool LoadTraversal(const uint32_t* HWY_RESTRICT top_left, uint32_t stride, uint32_t* HWY_RESTRICT pixels) {
  const hn::Full128<uint64_t> d;  // two pixels a lane: sub-blocks interleave pairs of two rows
  const auto first = hn::Set(d, uint64_t{top_left[0]} << 32 | top_left[0]);
  auto difference = hn::Zero(d);
  auto* out = reinterpret_cast<uint64_t*>(pixels);
  for (uint32_t y = 0; y < 8; y += 2) {
    const auto* upper = reinterpret_cast<const uint64_t*>(top_left + size_t{y} * stride);
    const auto* lower = reinterpret_cast<const uint64_t*>(top_left + size_t{y + 1} * stride);
    for (uint32_t x = 0; x < 4; x += 2) {
      const auto a = hn::LoadU(d, upper + x), b = hn::LoadU(d, lower + x);
      difference = hn::Or(difference, hn::Or(hn::Xor(a, first), hn::Xor(b, first)));
      hn::StoreU(hn::InterleaveLower(d, a, b), d, out);
      hn::StoreU(hn::InterleaveUpper(d, a, b), d, out + 2);
      out += 4;
    }
  }
  const hn::Full128<uint32_t> d32;
  return hn::AllTrue(d32, hn::Eq(hn::BitCast(d32, difference), hn::Zero(d32)));
}

void ReadRaw(const uint8_t* HWY_RESTRICT bytes, uint32_t* HWY_RESTRICT raster) {
  const hn::Full128<uint8_t> d;
  const hn::Full128<uint64_t> d64;  // two pixels a lane
  alignas(16) static constexpr uint8_t kBigEndian[16] = {3,  2,  1, 0, 7,  6,  5,  4,
                                                         11, 10, 9, 8, 15, 14, 13, 12};
  const auto big_endian = hn::Load(d, kBigEndian);
  for (uint32_t y = 0; y < 8; y += 2, raster += 16)
    for (uint32_t x = 0; x < 8; x += 4, bytes += 32) {
      const auto a = hn::BitCast(d64, hn::TableLookupBytes(hn::LoadU(d, bytes), big_endian));
      const auto b = hn::BitCast(d64, hn::TableLookupBytes(hn::LoadU(d, bytes + 16), big_endian));
      hn::StoreU(hn::InterleaveLower(d64, a, b), d64, reinterpret_cast<uint64_t*>(raster + x));
      hn::StoreU(hn::InterleaveUpper(d64, a, b), d64, reinterpret_cast<uint64_t*>(raster + 8 + x));
    }
}

uint32_t SolidBlocks(const uint32_t* HWY_RESTRICT top_left, uint32_t stride, uint32_t color, uint32_t most) {
  const hn::CappedTag<uint32_t, 8> d;
  const auto wanted = hn::Set(d, color);
  for (uint32_t n = 0; n < most; ++n, top_left += 8) {
    auto difference = hn::Zero(d);
    for (uint32_t y = 0; y < 8; ++y)
      for (size_t x = 0; x < 8; x += hn::Lanes(d))
        difference = hn::Or(difference, hn::Xor(hn::LoadU(d, top_left + size_t{y} * stride + x), wanted));
    if (!hn::AllTrue(d, hn::Eq(difference, hn::Zero(d)))) return n;
  }
  return most;
}

}  // namespace HWY_NAMESPACE
}  // namespace tilepress
HWY_AFTER_NAMESPACE();
#endif
#endif
