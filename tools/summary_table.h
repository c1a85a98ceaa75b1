// Summary table: the results of a run as text.
#pragma once

#include <string>

#include "tilepress/run_reader.h"

namespace tilepress {

/// A few lines, each with a newline: counts of frames, also of those without rows, and a row per scheme.
std::string summary_table(const RunRecord& run, const std::string& title);

}  // namespace tilepress
