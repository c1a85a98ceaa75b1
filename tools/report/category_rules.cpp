// Category rules: patterns of fnmatch().
#include "category_rules.h"

#include <fnmatch.h>

#include <algorithm>

#include "tilepress/nearest_word.h"

namespace tilepress {
namespace {

bool rule_matches(const std::string& rule, const std::string& workload) {
  return fnmatch(rule.substr(0, rule.rfind('=')).c_str(), workload.c_str(), 0) == 0;
}

}  // namespace

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
    if (rule_matches(rule, workload)) return rule.substr(rule.rfind('=') + 1);
  return otherwise;
}

Result<void> check_category_rules(const std::vector<std::string>& rules,
                                  const std::vector<std::string>& names) {
  constexpr size_t kNamesShown = 8;
  for (const std::string& rule : rules) {
    if (std::any_of(names.begin(), names.end(), [&](const auto& name) { return rule_matches(rule, name); }))
      continue;
    std::vector<std::string_view> shown(
        names.begin(), names.begin() + static_cast<ptrdiff_t>(std::min(names.size(), kNamesShown)));
    if (names.size() > kNamesShown) shown.push_back("…");
    return Error{ErrorKind::kBadValue, "--category " + rule + ": matches no workload (there are " +
                                           listed_words(shown, ", ") + ")"};
  }
  return {};
}

std::string RunCategories::of(const std::string& workload, const std::string& own) const {
  return own.empty() || recategorize ? category_by_rules(rules, workload, own) : own;
}

void add_run_category_options(CLI::App& app, RunCategories& categories) {
  add_category_option(app, categories.rules);
  app.add_flag("--recategorize", categories.recategorize,
               "Let --category replace the categories that runs have, not only fill in missing ones");
}

}  // namespace tilepress
