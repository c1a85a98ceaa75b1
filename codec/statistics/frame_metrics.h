// Frame metrics: what is read off the colour histograms of a frame and the one before (spec §8).
#pragma once

#include <cstdint>

#include "statistics/color_histogram.h"
#include "tilepress/plane.h"
#include "tilepress/statistics.h"

namespace tilepress {

class Fvc;

/// Keeps the histogram of the frame before as long as both fit into half the bytes of a raw frame each.
/// Frames with more colours are counted in several passes over both frames, each over a part of the colours.
class FrameMeter {
 public:
  /// Measures `frame`; `before` is the frame before it, or null. `fvc` is the default FVC, fed with `frame`.
  FrameMetrics measure(const PixelPlane& frame, const PixelPlane* before, const Fvc& fvc);

 private:
  /// Counts the colours of `frame` whose partition bits, under `mask`, equal `part`. False: no room.
  bool count_colors(const PixelPlane& frame, uint32_t mask, uint32_t part, ColorHistogram& out);
  /// Counts both frames in `parts` parts, a power of two. False: no room even so.
  bool count_in_parts(const PixelPlane& frame, const PixelPlane* before, const Fvc& fvc, uint32_t parts);
  /// Adds what the histograms of one part of the colours tell.
  void add_part(bool compare, const Fvc& fvc, uint32_t mask, uint32_t part);

  ColorHistogram now_, before_;
  uint32_t parts_ = 1;         ///< parts that the colours are likely to need
  bool before_valid_ = false;  ///< before_ holds the frame measured last
  size_t largest_table_ = 0;
  CountProfile profile_;
  uint64_t gained_ = 0;     ///< pixels that colours gained since the frame before
  uint64_t held_true_ = 0;  ///< true count of the colours that the FVC holds
};

}  // namespace tilepress
