// Category rules: --category PATTERN=NAME and --recategorize.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// Adds --category, which can be given several times. `rules` must outlive the parsing by `app`.
void add_category_option(CLI::App& app, std::vector<std::string>& rules);

/// The category of the first rule whose pattern matches the workload's name; else `otherwise`.
std::string category_by_rules(const std::vector<std::string>& rules, const std::string& workload,
                              const std::string& otherwise);

/// Fails with kBadValue if a rule matches none of the workloads `names`.
Result<void> check_category_rules(const std::vector<std::string>& rules,
                                  const std::vector<std::string>& names);

/// Rules for finished runs, which may have a category already.
struct RunCategories {
  std::vector<std::string> rules;
  bool recategorize = false;

  /// `own` is the category of the run. A rule replaces it only with --recategorize.
  std::string of(const std::string& workload, const std::string& own) const;
};

/// Adds --category and --recategorize.
void add_run_category_options(CLI::App& app, RunCategories& categories);

}  // namespace tilepress
