// Category rules: patterns of fnmatch().
#include "category_rules.h"

#include <fnmatch.h>

namespace tilepress {

void add_category_option(CLI::App& app, std::vector<std::string>& rules) {
  app.add_option("--category", rules,
                 "Category of the workloads whose names match, as 'glmark2*=3D'; repeatable")
      ->type_name("PATTERN=NAME")
      ->allow_extra_args(false)
      ->check([](const std::string& rule) {
        return rule.find('=') == std::string::npos ? "needs PATTERN=NAME, got '" + rule + "'" : "";
      });
}

std::string category_by_rules(const std::vector<std::string>& rules, const std::string& workload,
                              const std::string& otherwise) {
  for (const std::string& rule : rules)
    if (const size_t equals = rule.rfind('='); fnmatch(rule.substr(0, equals).c_str(), workload.c_str(), 0) == 0)
      return rule.substr(equals + 1);
  return otherwise;
}

}  // namespace tilepress
