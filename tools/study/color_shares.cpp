// Colour shares: one pass over a frame's counts.
#include "color_shares.h"

#include <algorithm>

namespace tilepress {

ColorShares::ColorShares() {
  for (uint64_t decade = 1; decade <= 100'000'000; decade *= 10)
    for (uint64_t digit = 1; digit < 10; ++digit) colors_.push_back(digit * decade);
  shares_.resize(colors_.size());
}

void ColorShares::add(const std::vector<ColorCount>& counts) {
  uint64_t pixels = 0, covered = 0;
  for (const ColorCount& color : counts) pixels += color.count;
  if (pixels == 0) return;
  size_t next = 0;
  for (size_t i = 0; i < colors_.size(); ++i) {
    for (; next < counts.size() && next < colors_[i]; ++next) covered += counts[next].count;
    shares_[i] += static_cast<double>(covered) / static_cast<double>(pixels);
  }
  ++frames_;
  most_colors_ = std::max<uint64_t>(most_colors_, counts.size());
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
