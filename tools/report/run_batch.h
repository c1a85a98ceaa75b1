// Run batch: finds the runs below the paths a user names, and names the workloads they hold.
#pragma once

#include <string>
#include <vector>

#include "tilepress/run_reader.h"

namespace tilepress {

/// A run directory and the name its workload goes by, unique in the batch.
struct BatchEntry {
  std::string path;
  std::string name;
};

/// Run directories at or below `paths`, in that order, the folders of one path sorted by name. Nothing and
/// one line in `error` if a path does not exist or holds no run.
std::vector<BatchEntry> find_runs(const std::vector<std::string>& paths, std::string& error);

/// What run.json says of the workload's kind ("UI", "2D", "3D", …); empty if nothing.
std::string workload_category(const RunRecord& run);

}  // namespace tilepress
