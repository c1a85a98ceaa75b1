// Highway helpers, compiled once per target: vectors of pixel words, and masks as bits.
#include "hwy/highway.h"

#if defined(TILEPRESS_CPU_HIGHWAY_H) == defined(HWY_TARGET_TOGGLE)  // once per target
#ifdef TILEPRESS_CPU_HIGHWAY_H
#undef TILEPRESS_CPU_HIGHWAY_H
#else
#define TILEPRESS_CPU_HIGHWAY_H
#endif

#include <cstddef>
#include <cstdint>

#undef TILEPRESS_HIGHWAY_BEGIN
#undef TILEPRESS_HIGHWAY_END
#define TILEPRESS_HIGHWAY_BEGIN \
  HWY_BEFORE_NAMESPACE();       \
  namespace tilepress {         \
  namespace HWY_NAMESPACE {     \
  namespace {                   \
  namespace hn = hwy::HWY_NAMESPACE;
#define TILEPRESS_HIGHWAY_END \
  }                           \
  }                           \
  }                           \
  HWY_AFTER_NAMESPACE();

// The plain kernels serve processors without SIMD.
#undef TILEPRESS_HAS_SIMD
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#define TILEPRESS_HAS_SIMD 1
#else
#define TILEPRESS_HAS_SIMD 0
#endif

#if TILEPRESS_HAS_SIMD
HWY_BEFORE_NAMESPACE();
namespace tilepress {
namespace HWY_NAMESPACE {

using Words = hwy::HWY_NAMESPACE::CappedTag<uint32_t, 16>;

/// Bit i is lane i of the mask.
template <class M>
HWY_INLINE uint64_t BitsOf(const Words& d, M mask) {
  uint8_t bytes[8] = {};
  hwy::HWY_NAMESPACE::StoreMaskBits(d, mask, bytes);
  uint64_t bits;
  __builtin_memcpy(&bits, bytes, 8);
  return bits;
}

/// Bit i of `color`'s places: pixel i of 64 is `color`.
HWY_INLINE uint64_t PlacesIn(const uint32_t* HWY_RESTRICT pixels, uint32_t color) {
  const Words d;
  const auto wanted = hwy::HWY_NAMESPACE::Set(d, color);
  uint64_t places = 0;
  for (size_t i = 0; i < 64; i += hwy::HWY_NAMESPACE::Lanes(d))
    places |= BitsOf(d, hwy::HWY_NAMESPACE::Eq(hwy::HWY_NAMESPACE::LoadU(d, pixels + i), wanted)) << i;
  return places;
}

}  // namespace HWY_NAMESPACE
}  // namespace tilepress
HWY_AFTER_NAMESPACE();
#endif
#endif
