// Frequent colours: counts runs, then takes the largest.
#include "dictionary/frequent_colors.h"

#include <algorithm>

#include "statistics/color_histogram.h"

namespace tilepress {

std::vector<FrequentColor> most_frequent_colors(const PixelPlane& frame, uint32_t limit) {
  ColorHistogram counts;
  counts.clear(std::max<size_t>(1024, size_t{frame.width()} * frame.height() * 3));  // always has room
  for (uint32_t y = 0; y < frame.height(); ++y) {
    const uint32_t* row = frame.row(y);
    for (uint32_t x = 0; x < frame.width();) {
      const uint32_t color = row[x], first = x;
      while (++x < frame.width() && row[x] == color) {
      }
      counts.add(color, x - first);
    }
  }
  counts.end_frame([](uint32_t, uint32_t) {});
  std::vector<FrequentColor> colors;
  counts.for_each_before([&](uint32_t color, uint32_t count) { colors.push_back({color, count}); });
  const auto end = colors.begin() + static_cast<ptrdiff_t>(std::min<size_t>(limit, colors.size()));
  std::partial_sort(colors.begin(), end, colors.end(), [](const FrequentColor& a, const FrequentColor& b) {
    return a.count != b.count ? a.count > b.count : a.color < b.color;
  });
  colors.erase(end, colors.end());
  return colors;
}

}  // namespace tilepress
