// Highway targets: what Highway compiles. Include this header before any other of Highway's.
//
// A file of Highway kernels compiles itself once per target:
//   #include "cpu/highway_targets.h"
//   #undef HWY_TARGET_INCLUDE
//   #define HWY_TARGET_INCLUDE "family/family_kernels_highway.cpp"
//   #include "hwy/foreach_target.h"
//   #include "cpu/highway.h"
//   TILEPRESS_HIGHWAY_BEGIN … functions and a constexpr struct of kernels … TILEPRESS_HIGHWAY_END
// The last pass (HWY_ONCE) lists the structs with TILEPRESS_KERNEL_SETS.
#pragma once

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)  // no faster than their neighbours
#include "hwy/detect_targets.h"

// `plain` where Highway compiled no version for a target: no processor runs that target then.
#if HWY_TARGETS & HWY_SSE4
#define TILEPRESS_SSE4_OR(plain, kernels) N_SSE4::kernels
#else
#define TILEPRESS_SSE4_OR(plain, kernels) plain
#endif
#if HWY_TARGETS & HWY_AVX2
#define TILEPRESS_AVX2_OR(plain, kernels) N_AVX2::kernels
#else
#define TILEPRESS_AVX2_OR(plain, kernels) plain
#endif
#if HWY_TARGETS & HWY_AVX3
#define TILEPRESS_AVX512_OR(plain, kernels) N_AVX3::kernels
#else
#define TILEPRESS_AVX512_OR(plain, kernels) plain
#endif
#if HWY_TARGETS & HWY_NEON
#define TILEPRESS_NEON_OR(plain, kernels) N_NEON::kernels
#else
#define TILEPRESS_NEON_OR(plain, kernels) plain
#endif

/// The initializer of a family's KernelSets. `kernels` is the name that the struct has in each target's
/// namespace.
#define TILEPRESS_KERNEL_SETS(plain, kernels, vbmi)                                       \
  {                                                                                       \
    {                                                                                     \
      &plain, &TILEPRESS_NEON_OR(plain, kernels), &TILEPRESS_SSE4_OR(plain, kernels),     \
          &TILEPRESS_AVX2_OR(plain, kernels), &TILEPRESS_AVX512_OR(plain, kernels), &vbmi \
    }                                                                                     \
  }
