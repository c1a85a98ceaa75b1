// Capture screen: running captures as lines of text, from two snapshots of each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/live_page.h"

namespace tilepress {

struct WatchedCapture {
  std::string path;
  LiveState before{}, now{};
  double elapsed_s = 0;  ///< between the two snapshots; 0 = there is one snapshot only
  bool ended = false;
};

/// Returns the lines of one capture, each at most `columns` wide: program and size, frames per second and
/// counts, costs, and a line per scheme with its rate over the run and in the last frame. A scheme that
/// causes further traffic also has the run's rate with it.
std::vector<std::string> capture_lines(const WatchedCapture& capture, size_t columns);

/// Returns a name from shared memory, with '?' for each character that is not printable ASCII.
std::string printable_name(const char (&name)[kLiveNameBytes]);

/// Returns raw / moved with three decimals, or "-" if nothing moved, right-aligned in `columns`.
std::string rate_text(uint64_t raw_bits, uint64_t moved_bits, int columns);

/// Returns the frames captured per second between the snapshots; NaN with one snapshot.
double frames_per_second(const WatchedCapture& capture);

}  // namespace tilepress
