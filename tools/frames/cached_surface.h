// Cached surface: the frames of a frame cache as one sequence.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "study/cache/frame_cache.h"

namespace tilepress {

struct CachedSurface {
  std::shared_ptr<const FrameCacheReader> cache;
  uint32_t width = 0, height = 0;
  PixelFormat format = PixelFormat::kRgba8;
  std::vector<uint32_t> frames;  ///< indices in the cache, in order
  std::string left_out;          ///< one line about further surfaces; empty if there are none
};

/// Whether the file begins as a frame cache.
bool is_frame_cache(const std::string& path);

/// Opens a frame cache and takes the surface with the most frames, the first one of several. Error texts do
/// not name the file: it is damaged, empty, or its format is not modelled.
Result<CachedSurface> largest_cached_surface(const std::string& path);

}  // namespace tilepress
