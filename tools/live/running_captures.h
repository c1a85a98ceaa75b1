// Running captures: the run directories below some folders that a capture is writing to.
#pragma once

#include <string>
#include <vector>

namespace tilepress {

/// Run directories with a live page, at or up to four levels below the folders, in the order of their names.
std::vector<std::string> find_running_captures(const std::vector<std::string>& folders);

/// Whether the capture still goes on: it has its page, and a process of any PID namespace writes the run.
bool capture_runs(const std::string& run_path);

}  // namespace tilepress
