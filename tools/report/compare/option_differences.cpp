// Option differences: run.json keeps each option under its own key.
#include "report/compare/option_differences.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "tilepress/run_option_table.h"

namespace tilepress {
namespace {

using Json = nlohmann::json;

Json options_of(const std::string& run) {
  std::ifstream file(run + "/run.json");
  const Json json = Json::parse(file, nullptr, false);
  return json.is_object() && json.contains("options") && json["options"].is_object() ? json["options"]
                                                                                     : Json::object();
}

std::string shown(const Json& value) {
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  return text.empty() ? "none" : text;
}

}  // namespace

std::vector<std::string> option_differences(const std::string& run_a, const std::string& run_b) {
  const Json a = options_of(run_a), b = options_of(run_b);
  std::vector<std::string> out;
  for (const RunOption& option : run_option_table()) {
    const std::string key(option.json.key);
    if (option.rows == RowsEffect::kNone || option.name == "scheme" || option.name == "verify") continue;
    if (!a.contains(key) || !b.contains(key) || a[key] == b[key]) continue;
    out.push_back(std::string(option.name) + " " + shown(a[key]) + " in A, " + shown(b[key]) + " in B");
  }
  return out;
}

}  // namespace tilepress
