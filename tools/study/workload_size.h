// Workload size: how much there is to render and to model, known before any work.
#pragma once

#include <cstdint>
#include <string>

#include "study/cache/cached_rendering.h"
#include "study/cache/frame_cache.h"
#include "study/inputs.h"

namespace tilepress {

struct WorkloadSize {
  uint64_t frames = 0;     ///< 0 = not known
  uint64_t pixels = 0;     ///< of all frames
  bool to_render = false;  ///< a trace whose frames are not in the cache
  std::string note;        ///< for people: where the frames are, or why they are not known
};

/// Reads the calls of a trace, the index of a cache file or the first image. Renders nothing.
WorkloadSize size_of_workload(const Workload& workload, const RenderOptions& render);

/// Returns the pixels of all frames.
uint64_t pixels_of(const FrameCacheReader& cache);

}  // namespace tilepress
