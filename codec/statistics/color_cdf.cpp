// Colour CDF: sorts a frame's pixels, counts runs, sorts the counts. Coverage needs the counts alone.
#include "tilepress/color_cdf.h"

#include <algorithm>
#include <cstdio>

#include "statistics/color_distribution.h"
#include "tilepress/plane.h"

namespace tilepress {
namespace {

constexpr CsvColumn<ColorCdfRow> kColumns[] = {
    csv_column<ColorCdfRow, &ColorCdfRow::frame>("frame"),
    csv_column<ColorCdfRow, &ColorCdfRow::surface>("surface"),
    csv_column<ColorCdfRow, &ColorCdfRow::rank>("rank"),
    csv_column<ColorCdfRow, &ColorCdfRow::color>("color"),
    csv_column<ColorCdfRow, &ColorCdfRow::count>("count"),
    csv_column<ColorCdfRow, &ColorCdfRow::cumulative>("cumulative"),
};

/// Returns a key that sorts words like their color_text: red first.
uint64_t text_order(uint32_t color, const FormatTraits& format) {
  uint64_t key = 0;
  for (int c = 0; c < 4; ++c) key = key << 16 | channel(format, color, c);
  return key;
}

}  // namespace

std::vector<ColorCount> color_counts(const SurfaceView& frame) {
  PixelPlane plane;
  plane.assign(frame);
  std::vector<uint32_t> words;
  words.reserve(size_t{plane.width()} * plane.height());
  for (uint32_t y = 0; y < plane.height(); ++y)
    words.insert(words.end(), plane.row(y), plane.row(y) + plane.width());
  std::sort(words.begin(), words.end());
  std::vector<ColorCount> counts;
  for (const uint32_t word : words) {
    if (counts.empty() || counts.back().color != word) counts.push_back({word, 0});
    ++counts.back().count;
  }
  const FormatTraits& format = traits(frame.format);
  std::sort(counts.begin(), counts.end(), [&](const ColorCount& a, const ColorCount& b) {
    return a.count != b.count ? a.count > b.count : text_order(a.color, format) < text_order(b.color, format);
  });
  return counts;
}

ColorCoverage color_coverage(const SurfaceView& frame, std::span<const uint64_t> colors) {
  PixelPlane plane;
  plane.assign(frame);
  CountProfile profile;
  profile.clear();
  ColorDistribution().count(plane, false, {}, profile);
  profile.close();
  ColorCoverage coverage{profile.colors(), {}};
  for (const uint64_t most : colors) coverage.pixels.push_back(profile.most_frequent(most));
  return coverage;
}

std::string color_text(uint32_t color, PixelFormat format) {
  const FormatTraits& bits = traits(format);
  uint32_t value[4];
  for (int c = 0; c < 4; ++c) value[c] = channel(bits, color, c);
  char text[40];  // also fits values that the compiler cannot rule out
  if (format == PixelFormat::kRgb10a2) {
    std::snprintf(text, sizeof text, "#%03X%03X%03X%X", value[0], value[1], value[2], value[3]);
    return text;
  }
  for (int c = 0; c < 4; ++c) {
    const uint32_t width = bits.channel_bits[c];
    if (width == 0) value[c] = 255;
    if (width > 0 && width < 8) value[c] = value[c] << (8 - width) | value[c] >> (2 * width - 8);
  }
  std::snprintf(text, sizeof text, "#%02X%02X%02X%02X", value[0], value[1], value[2], value[3]);
  return text;
}

std::span<const CsvColumn<ColorCdfRow>> color_cdf_columns() {
  return kColumns;
}

std::string color_cdf_header() {
  return csv_header(kColumns);
}

void append_color_cdf(uint64_t frame, uint32_t surface, PixelFormat format,
                      const std::vector<ColorCount>& counts, std::string& out) {
  uint64_t pixels = 0, so_far = 0;
  for (const ColorCount& entry : counts) pixels += entry.count;
  ColorCdfRow row;
  row.frame = frame;
  row.surface = surface;
  for (const ColorCount& entry : counts) {
    so_far += entry.count;
    ++row.rank;
    const std::string color = color_text(entry.color, format);
    row.color = color;
    row.count = entry.count;
    row.cumulative = static_cast<double>(so_far) / static_cast<double>(pixels);
    append_csv_row(kColumns, row, out);
  }
}

}  // namespace tilepress
