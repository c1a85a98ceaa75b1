// Present series: the frame times of a program.
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

}  // namespace tilepress
