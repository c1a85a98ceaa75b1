// Ended runs: what top and view say where nothing runs any more.
#pragma once

#include <string>

namespace tilepress {

/// Returns "2 ended runs are there; `tilepress report DIR -o report.html` shows them", or an empty text if
/// `folder` holds a running capture or no run.
std::string ended_runs_text(const std::string& folder);

}  // namespace tilepress
