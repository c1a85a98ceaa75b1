// Overhead report: frame times of a program with and without the shim, for people and as rows.
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

/// A line per run, and the frame-time ratio: mean frame time with over without, over all rounds together and
/// the smallest and largest of a round. Says so where a side presented too little to tell.
std::string overhead_text(const std::vector<OverheadRun>& runs);

/// The file overhead.csv: a row per run; the ratios stand in the rows with the shim.
std::string overhead_csv(const std::vector<OverheadRun>& runs);

}  // namespace tilepress
