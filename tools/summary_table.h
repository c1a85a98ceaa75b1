// Summary table: what a run came to, for people.
#pragma once

#include <string>

#include "tilepress/run_reader.h"

namespace tilepress {

/// A few lines, each ending in a newline: counts, a row per scheme, and the frames that could not be taken
/// and why.
std::string summary_table(const RunRecord& run, const std::string& title);

}  // namespace tilepress
