// Present series: when the frames of a program were presented, and the frame times that follow.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tilepress {

/// The frames of one window.
struct PresentSeries {
  uint64_t presents = 0;
  std::vector<double>
      intervals_ns;    ///< from present to present, ascending, without the first: programs start up in it
  double hook_ns = 0;  ///< mean over the same frames of what the shim took on the program's thread
  double mean_ns() const;
  /// The interval that the share `part` (0 … 1) of them does not exceed; 0 if there is none.
  double quantile_ns(double part) const;
};

/// The window that presented most among all processes whose shims left `<pid>.times` in `folder`.
PresentSeries busiest_series(const std::string& folder);

}  // namespace tilepress
