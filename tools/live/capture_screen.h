// Capture screen: running captures as lines of text, from two snapshots of each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/live_page.h"

namespace tilepress {

/// One capture on the screen.
struct WatchedCapture {
  std::string path;
  LiveState before{}, now{};
  double elapsed_s = 0;  ///< between the two snapshots; 0 = there is only one
  bool ended = false;
};

/// The lines of one capture, each at most `columns` wide: program and size, frames per second and counts,
/// what capturing costs, and a line per scheme with its rate over the run and of the last frame; where a scheme
/// causes further traffic, also the run's rate with it.
std::vector<std::string> capture_lines(const WatchedCapture& capture, size_t columns);

/// A name from shared memory, what is not printable as '?'.
std::string printable_name(const char (&name)[kLiveNameBytes]);

/// Frames per second captured between the snapshots; NaN if there is one only.
double frames_per_second(const WatchedCapture& capture);

}  // namespace tilepress
