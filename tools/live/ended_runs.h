// Ended runs: what top and view say where nothing runs any more.
#pragma once

#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// Returns "2 ended runs are there; `tilepress report DIR -o report.html` shows them", or an empty text if
/// `folder` holds a running capture or no run.
std::string ended_runs_text(const std::string& folder);

/// Fails with kFile if a file lies in the place of one of the folders. A folder may be missing: a capture can
/// make it.
Result<void> check_capture_folders(const std::vector<std::string>& folders);

}  // namespace tilepress
