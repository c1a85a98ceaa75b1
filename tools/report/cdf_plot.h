// CDF plot: the share of pixels that the most frequent colours cover, from a run's cdf.csv.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "line_plot.h"

namespace tilepress {

struct CdfPlot {
  uint32_t surface = 0;
  LinePlot plot;
};

/// One plot per surface in <run_path>/cdf.csv, with a line for each of up to six of its frames, spread evenly.
/// The ranks are 1 … 10, then in steps of about a tenth. Every value is a cell of the file. Returns nothing
/// without the file, or for a file of another kind.
std::vector<CdfPlot> load_cdf_plots(const std::string& run_path, const std::string& slug);

}  // namespace tilepress
