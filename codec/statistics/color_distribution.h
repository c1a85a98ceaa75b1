// Color distribution: exact colour counts of frames of many colours, by sorting pixels into groups.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "statistics/color_histogram.h"
#include "tilepress/plane.h"

namespace tilepress {

/// Pixels are distributed to groups by the upper 16 bits of their word; the lower 16 bits then index a table
/// of counts directly. No search and hardly a branch depends on the colours, so a frame of noise costs little
/// more than a frame of shades.
///
/// Memory: 2 bytes a pixel, and a megabyte that all surfaces of a thread share.
class ColorDistribution {
 public:
  struct Change {
    uint64_t gained = 0;  ///< pixels that colours gained since the frame before; 0 without one
    uint64_t held = 0;    ///< pixels whose colour is one of `held_colors`
  };
  /// Adds the counts of the colours of `frame` to `profile`. `before` may be null; its pixels are
  /// overwritten. `held_colors` are distinct; their order is changed.
  Change count(const PixelPlane& frame, PixelPlane* before, std::span<uint32_t> held_colors,
               CountProfile& profile);

 private:
  std::vector<uint16_t> values_;  ///< of the frame before (or of the frame, where there is none), by group
};

}  // namespace tilepress
