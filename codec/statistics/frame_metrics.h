// Frame metrics: what is read off the colour histograms of a frame and the one before (spec §8).
#pragma once

#include <cstdint>

#include "statistics/color_distribution.h"
#include "statistics/color_histogram.h"
#include "tilepress/plane.h"
#include "tilepress/statistics.h"

namespace tilepress {

class Fvc;

/// Frames of few colours are counted in hash tables, kept for the next frame, that take an eighth of a raw
/// frame together; frames of many are distributed.
class FrameMeter {
 public:
  /// Measures `frame`; `before` is the frame before it, or null. `fvc` is the default FVC, fed with `frame`.
  /// The pixels of `before` may be overwritten.
  FrameMetrics measure(const PixelPlane& frame, PixelPlane* before, const Fvc& fvc);

 private:
  /// False: no room for all colours.
  bool count_colors(const PixelPlane& frame, ColorHistogram& out);
  /// False: too many colours; nothing was counted.
  bool count_few(const PixelPlane& frame, const PixelPlane* before, const Fvc& fvc);
  void count_many(const PixelPlane& frame, PixelPlane* before, const Fvc& fvc);

  ColorHistogram now_, before_;
  bool before_valid_ = false;  ///< before_ holds the frame measured last
  bool many_ = false;          ///< colours are to be expected
  ColorDistribution distribution_;
  CountProfile profile_;
  ColorDistribution::Change change_;
};

}  // namespace tilepress
