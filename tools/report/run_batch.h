// Run batch: finds the runs below the paths that a user names, and names their workloads.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tilepress/result.h"
#include "tilepress/run_reader.h"

namespace tilepress {

/// A run directory and the name of its workload, unique in the batch.
struct BatchEntry {
  std::string path;
  std::string name;
};

/// Returns the run directories at or below `paths`, in that order, the folders of one path sorted by name. A
/// workload has the name in its run.json, or else that of the folder without the number of the process.
/// Fails if a path does not exist or holds no run.
Result<std::vector<BatchEntry>> find_runs(const std::vector<std::string>& paths);

std::vector<std::string> names_of(const std::vector<BatchEntry>& entries);

/// run.json of the run in folder `path`. An empty object without the file, or if it is damaged.
nlohmann::json run_document(const std::string& path);

/// The workload's category ("UI", "2D", "3D", …) in run.json; empty if there is none.
std::string workload_category(const RunRecord& run);

}  // namespace tilepress
