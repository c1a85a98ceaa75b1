// Overhead report: frame times of a program with and without the shim, as a table and as CSV.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tilepress {

/// The frames of one window.
struct PresentSeries {
  uint64_t presents = 0;
  std::vector<double> intervals_ns;  ///< from present to present, ascending, without the first, a start-up
  double hook_ns = 0;                ///< the shim's mean time on the program's thread, over the same frames
  double mean_ns() const;
  /// Returns the interval that the share `part` (0 … 1) of them does not exceed; 0 without intervals.
  double quantile_ns(double part) const;
};

/// Returns the window that presented most, of all processes whose shims left `<pid>.times` in `folder`.
PresentSeries busiest_series(const std::string& folder);

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
