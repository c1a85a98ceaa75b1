// Category rules: --category PATTERN=NAME.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace tilepress {

/// Adds --category, which can be given several times. `rules` must outlive the parsing by `app`.
void add_category_option(CLI::App& app, std::vector<std::string>& rules);

/// The category of the first rule whose pattern matches the workload's name; else `otherwise`.
std::string category_by_rules(const std::vector<std::string>& rules, const std::string& workload,
                              const std::string& otherwise);

}  // namespace tilepress
