// Running captures: finds the run directories that captures are writing to.
#pragma once

#include <string>
#include <vector>

namespace tilepress {

/// Returns the run directories with a live page, at most four levels below the folders, sorted.
std::vector<std::string> find_running_captures(const std::vector<std::string>& folders);

/// Whether the capture still runs: its page exists, and a process of any PID namespace writes the run.
bool capture_runs(const std::string& run_path);

}  // namespace tilepress
