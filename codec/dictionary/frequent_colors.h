// Frequent colours of a frame: an exact count, for dictionaries made from a whole frame.
#pragma once

#include <cstdint>
#include <vector>

#include "tilepress/plane.h"

namespace tilepress {

struct FrequentColor {
  uint32_t color;
  uint32_t count;
};

/// Returns the `limit` most frequent colours inside the surface, the most frequent first. Ties are in
/// ascending order of the pixel word.
std::vector<FrequentColor> most_frequent_colors(const PixelPlane& frame, uint32_t limit);

}  // namespace tilepress
