// Frame metrics: what is read off the colour histograms of a frame and the one before (spec §8).
#pragma once

#include <cstdint>
#include <optional>

#include "statistics/color_distribution.h"
#include "statistics/color_histogram.h"
#include "tilepress/plane.h"
#include "tilepress/statistics.h"

namespace tilepress {

class Fvc;

/// Frames of few colours are counted in hash tables that take an eighth of a raw frame together; frames of
/// many are distributed. Either way the colours are kept for the next frame.
class FrameMeter {
 public:
  /// Measures `frame`. `changed`: its pixels that differ from those of the frame measured last, which had the
  /// same size; none if there was no such frame. `fvc` is the default FVC, fed with `frame`.
  FrameMetrics measure(const PixelPlane& frame, std::optional<uint64_t> changed, const Fvc& fvc);

 private:
  /// False: no room for all colours.
  bool count_colors(const PixelPlane& frame, ColorHistogram& out);
  void count_few(bool compare, const Fvc& fvc);
  void count_many(const PixelPlane& frame, bool compare, const Fvc& fvc);

  ColorHistogram now_, before_;
  bool hashed_ = false;  ///< the colours measured last are in now_; otherwise distributed
  bool many_ = false;    ///< colours are to be expected
  ColorDistribution distribution_;
  CountProfile profile_;
  ColorDistribution::Change change_;
};

}  // namespace tilepress
