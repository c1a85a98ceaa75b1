// Overhead report: frame times of a program with and without the shim, as a table and as CSV.
#pragma once

#include <string>
#include <vector>

#include "capture/present_series.h"

namespace tilepress {

/// One run of the program.
struct OverheadRun {
  unsigned round = 0;
  bool captured = false;  ///< false: the shim only counted
  int exit_status = 0;
  PresentSeries series;
};

/// Returns a line per run and the frame-time ratio: the mean frame time with the shim over that without, for
/// all rounds together, and the smallest and largest of a round. Without enough frames, a line says so.
std::string overhead_text(const std::vector<OverheadRun>& runs);

/// Returns overhead.csv: a row per run. Rows with the shim have the ratios.
std::string overhead_csv(const std::vector<OverheadRun>& runs);

}  // namespace tilepress
