// Histogram kernels: the plain definition and the version by Highway.
#include "statistics/histogram_kernels.h"
#include "cpu/highway_targets.h"
#include "cpu/mask_runs.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "statistics/histogram_kernels.cpp"
#include "hwy/foreach_target.h"  // before Highway's other headers

#include "cpu/highway.h"

#if TILEPRESS_HAS_SIMD
TILEPRESS_HIGHWAY_BEGIN

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

constexpr HistogramKernels kHistogramKernels = {.count_runs = CountRuns};

TILEPRESS_HIGHWAY_END
#endif

#if HWY_ONCE
namespace tilepress {
namespace {

uint64_t count_runs(const uint32_t* pixels, uint64_t begins, uint32_t end, ColorBucket* table,
                    size_t buckets) {
  uint64_t others = 0;
  for_each_mask_run(begins, end, [&](uint32_t first, uint32_t length) {
    ColorBucket& bucket = table[ColorBucket::of(pixels[first], buckets)];
    const uint32_t place = bucket.find(pixels[first]);
    if (place < ColorBucket::kPlaces)
      bucket.counts[place] += length;
    else
      others |= uint64_t{1} << first;
  });
  return others;
}

}  // namespace

constexpr HistogramKernels kPlainHistogramKernels = {.count_runs = count_runs};
constexpr KernelSets<HistogramKernels> kHistogramKernelSets =
    TILEPRESS_KERNEL_SETS(kPlainHistogramKernels, kHistogramKernels,
                          TILEPRESS_AVX512_OR(kPlainHistogramKernels, kHistogramKernels));

}  // namespace tilepress
#endif
