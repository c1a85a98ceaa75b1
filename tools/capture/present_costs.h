// Present costs: the cost of capturing a frame, from presents.csv and frames.csv of a run.
#pragma once

#include <string>

#include "tilepress/run_reader.h"

namespace tilepress {

/// Means over the captured frames that are not warmup.
struct PresentCosts {
  uint64_t frames = 0;  ///< 0 = the run has no presents.csv: it was not captured from a program
  double readback_ns = 0, read_ns = 0, bind_ns = 0, hand_off_ns = 0;  ///< on the program's thread
  double wait_ns = 0;    ///< on that thread, for room in the queue
  double encode_ns = 0;  ///< on the worker's thread
};

PresentCosts present_costs(const RunRecord& run);

/// Returns lines for people, each ending in a newline; empty without costs.
std::string present_costs_text(const PresentCosts& costs);

}  // namespace tilepress
