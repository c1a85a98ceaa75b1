// Colour CDF: how many pixels the most frequent colours of a frame cover (paper, Figures 2 to 4).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/csv_table.h"
#include "tilepress/surface.h"

namespace tilepress {

struct ColorCount {
  uint32_t color;  ///< pixel word
  uint64_t count;  ///< pixels inside the surface
};

/// Returns every colour of the frame, the most frequent first. Ties are in the order of color_text.
/// Precondition: a modelled format.
std::vector<ColorCount> color_counts(const SurfaceView& frame);

/// How many pixels of a frame its most frequent colours cover.
struct ColorCoverage {
  uint64_t colors = 0;           ///< distinct colours of the frame
  std::vector<uint64_t> pixels;  ///< covered, for each number of colours that was asked for
};

/// Returns the pixels that the n most frequent colours cover, for each n in `colors`: a part of what
/// color_counts() tells, in less time. Precondition: a modelled format.
ColorCoverage color_coverage(const SurfaceView& frame, std::span<const uint64_t> colors);

/// Returns "#RRGGBBAA". Channels narrower than 8 bits are widened by repeating their high bits; absent alpha
/// is FF. RGB10A2 returns its plain values "#RRRGGGBBBA": three digits per colour channel and one for alpha.
std::string color_text(uint32_t color, PixelFormat format);

/// A row of cdf.csv: a colour of a frame.
struct ColorCdfRow {
  uint64_t frame = 0;
  uint32_t surface = 0;
  uint64_t rank = 0;       ///< from 1, the most frequent colour
  std::string_view color;  ///< color_text()
  uint64_t count = 0;      ///< pixels
  double cumulative = 0;   ///< share of the frame's pixels that this and all more frequent colours cover
};
std::span<const CsvColumn<ColorCdfRow>> color_cdf_columns();

std::string color_cdf_header();
/// Appends the rows of a frame, in the order of `counts`.
void append_color_cdf(uint64_t frame, uint32_t surface, PixelFormat format,
                      const std::vector<ColorCount>& counts, std::string& out);

}  // namespace tilepress
