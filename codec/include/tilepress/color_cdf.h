// Colour CDF: how many pixels the most frequent colours of a frame cover (paper, Figures 2 to 4).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/surface.h"

namespace tilepress {

struct ColorCount {
  uint32_t color;  ///< pixel word
  uint64_t count;  ///< pixels inside the surface
};

/// Every colour of the frame, the most frequent first; ties in the order of color_text.
/// Precondition: a modelled format.
std::vector<ColorCount> color_counts(const SurfaceView& frame);

/// "#RRGGBBAA". Channels narrower than 8 bits are widened by repeating their high bits, absent alpha is FF;
/// RGB10A2 has three digits a colour channel and one of alpha, "#RRRGGGBBBA", its plain values.
std::string color_text(uint32_t color, PixelFormat format);

/// CSV: frame,surface,rank,color,count,cumulative. Ranks from 1; cumulative is the share of the frame's
/// pixels in this and all more frequent colours, 1 in the last row.
std::string color_cdf_header();
void append_color_cdf(uint64_t frame, uint32_t surface, PixelFormat format,
                      const std::vector<ColorCount>& counts, std::string& out);

}  // namespace tilepress
