// Colour shares: sums of the coverage of frames.
#include "color_shares.h"

#include <algorithm>

#include "tilepress/color_cdf.h"
#include "tilepress/csv_table.h"

namespace tilepress {

ColorShares::ColorShares() {
  for (uint64_t decade = 1; decade <= 100'000'000; decade *= 10)
    for (uint64_t digit = 1; digit < 10; ++digit) colors_.push_back(digit * decade);
  shares_.resize(colors_.size());
}

void ColorShares::add(const SurfaceView& frame) {
  const ColorCoverage coverage = color_coverage(frame, colors_);
  const double pixels = static_cast<double>(frame.width) * frame.height;
  for (size_t i = 0; i < colors_.size(); ++i) shares_[i] += static_cast<double>(coverage.pixels[i]) / pixels;
  ++frames_;
  most_colors_ = std::max(most_colors_, coverage.colors);
}

std::string ColorShares::text() const {
  std::string out = "colors,pixels_share\n";
  for (size_t i = 0; frames_ > 0 && i < colors_.size(); ++i) {
    out += std::to_string(colors_[i]) + "," + csv_number(shares_[i] / static_cast<double>(frames_)) + "\n";
    if (colors_[i] >= most_colors_) break;
  }
  return out;
}

}  // namespace tilepress
