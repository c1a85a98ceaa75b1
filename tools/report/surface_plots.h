// Surface plots: the line charts of one surface.
#pragma once

#include <cstdint>
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

/// The charts as a JSON list for the page's script. Surfaces without plots are left out.
std::string surfaces_json(const std::vector<SurfacePlots>& surfaces);

/// Rates, changes and colours over the surface's `frames`, which are not empty. Each line has at most
/// `max_points` values. `slug`: start of the names of CSV downloads.
SurfacePlots plot_surface(const RunRecord& run, const std::string& slug,
                          const std::vector<const FrameStatistics*>& frames, size_t max_points);

struct CdfPlot {
  uint32_t surface = 0;
  LinePlot plot;
};

/// One plot per surface in <run_path>/cdf.csv, with a line for each of up to six of its frames, spread
/// evenly. The ranks are 1 … 10, then in steps of about a tenth. Every value is a cell of the file. Returns
/// nothing without the file, or for a file of another kind.
std::vector<CdfPlot> load_cdf_plots(const std::string& run_path, const std::string& slug);

}  // namespace tilepress
