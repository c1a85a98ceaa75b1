// Frequent colours: counts runs, then takes the largest.
#include "dictionary/frequent_colors.h"

#include <algorithm>
#include <unordered_map>

namespace tilepress {

std::vector<FrequentColor> most_frequent_colors(const PixelPlane& frame, uint32_t limit) {
  std::unordered_map<uint32_t, uint32_t> counts;
  for (uint32_t y = 0; y < frame.height(); ++y) {
    const uint32_t* row = frame.row(y);
    for (uint32_t x = 0; x < frame.width();) {
      const uint32_t color = row[x], first = x;
      while (++x < frame.width() && row[x] == color) {
      }
      counts[color] += x - first;
    }
  }
  std::vector<FrequentColor> colors;
  colors.reserve(counts.size());
  for (const auto& [color, count] : counts) colors.push_back({color, count});
  const auto end = colors.begin() + static_cast<ptrdiff_t>(std::min<size_t>(limit, colors.size()));
  std::partial_sort(colors.begin(), end, colors.end(), [](const FrequentColor& a, const FrequentColor& b) {
    return a.count != b.count ? a.count > b.count : a.color < b.color;
  });
  colors.erase(end, colors.end());
  return colors;
}

}  // namespace tilepress
