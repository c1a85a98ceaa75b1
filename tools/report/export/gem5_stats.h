// gem5 statistics: a run as the stats.txt that architecture simulators and their scripts read.
#pragma once

#include <string>

#include "tilepress/run_reader.h"

namespace tilepress {

/// One dump ("Begin Simulation Statistics" … "End") with the run's sums. With `per_frame` one dump per frame
/// that is not warm-up. Lines are `name value # description (Unit)`. Names start with `prefix` and a dot.
std::string gem5_stats(const RunRecord& run, const std::string& prefix, bool per_frame);

/// `text` as one part of a statistic's name. Letters, digits and '_' stay; other characters become '_'.
std::string gem5_name(const std::string& text);

}  // namespace tilepress
