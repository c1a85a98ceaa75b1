// Workload options: the name and category that a new run gets.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <utility>
#include <vector>

namespace tilepress {

/// What run.json calls the workload. Empty: not given.
struct WorkloadLabel {
  std::string name, category;

  /// The members of run.json for what is given.
  std::vector<std::pair<std::string, std::string>> members() const;
};

/// Adds --name and --category.
void add_workload_options(CLI::App& app, WorkloadLabel& label);

}  // namespace tilepress
