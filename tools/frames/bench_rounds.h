// Bench rounds: interleaved timing of every operation on a set of frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tilepress/pixel_format.h"
#include "tilepress/scheme_spec.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

/// Decoded frames of one size: R,G,B,A bytes, tight rows.
struct BenchFrames {
  uint32_t width = 0, height = 0;
  PixelFormat format = PixelFormat::kRgba8;
  std::vector<std::vector<std::byte>> pixels;
};

/// Medians over the rounds. A ratio above 1 means faster; both speeds come from the same round.
struct BenchRow {
  std::string scheme;     ///< a scheme, "all", "metrics", "memcpy" or "lz4"
  std::string operation;  ///< statistics, encode, decode, copy, compress
  double mpixels_per_s = 0;
  double ratio_to_memcpy = 0;
  double ratio_to_lz4 = 0;
  double cycles_per_pixel = 0;  ///< of the time-stamp counter; 0 on machines without one
};

/// Calls `round_done` after each round with the number of rounds so far.
std::vector<BenchRow> bench_set(const BenchFrames& frames, const std::vector<SchemeSpec>& schemes,
                                const ModelOptions& model, uint32_t rounds,
                                const std::function<void(uint32_t)>& round_done);

}  // namespace tilepress
