// Frequent colours of a frame: an exact count, for dictionaries made from a whole frame.
#pragma once

#include <cstdint>
#include <vector>

#include "tilepress/plane.h"

namespace tilepress {

struct ColorCount {
  uint32_t color;
  uint32_t count;
};

/// The `limit` most frequent colours inside the surface, the most frequent first; equally frequent ones by
/// ascending pixel word.
std::vector<ColorCount> most_frequent_colors(const PixelPlane& frame, uint32_t limit);

}  // namespace tilepress
