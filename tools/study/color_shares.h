// Colour shares: the share of pixels that the most frequent colours cover, as a mean over frames.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/surface.h"

namespace tilepress {

/// Adds frames up. The counts of colours are 1, 2, 3, … 10, 20, 30, … 100, 200, …, up to the first count that
/// covers every frame.
class ColorShares {
 public:
  ColorShares();
  void add(const SurfaceView& frame);
  /// CSV: colors, pixels_share.
  std::string text() const;

 private:
  std::vector<uint64_t> colors_;
  std::vector<double> shares_;  ///< sums over frames
  uint64_t frames_ = 0, most_colors_ = 0;
};

}  // namespace tilepress
