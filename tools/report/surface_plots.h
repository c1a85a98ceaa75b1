// Surface plots: the line charts of one surface.
#pragma once

#include <string>
#include <vector>

#include "line_plot.h"
#include "tilepress/run_reader.h"

namespace tilepress {

/// The line charts of one surface.
struct SurfacePlots {
  std::string label;  ///< "surface 0, 720×1280 RGBA8, 300 frames"
  std::vector<LinePlot> plots;
};

/// Rates, changes and colours over the surface's `frames`, which are not empty. Each line has at most
/// `max_points` values. `slug`: start of the names of CSV downloads.
SurfacePlots plot_surface(const RunRecord& run, const std::string& slug,
                          const std::vector<const FrameStatistics*>& frames, size_t max_points);

}  // namespace tilepress
