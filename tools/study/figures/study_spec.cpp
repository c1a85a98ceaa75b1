// Study specification: from JSON to structs. Unknown keys are for other parts of the study.
#include "study/figures/study_spec.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tilepress/csv_table.h"
#include "tilepress/whole_file.h"

namespace tilepress {
namespace {

using Json = nlohmann::ordered_json;

/// A string as it is, a number or boolean as text, nothing for null.
std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return csv_number(value.get<double>());
  return value.is_null() ? "" : value.dump();
}

std::string text_at(const Json& object, const char* key, const std::string& otherwise = "") {
  return object.contains(key) ? text_of(object.at(key)) : otherwise;
}

std::vector<std::string> texts_at(const Json& object, const char* key) {
  std::vector<std::string> out;
  if (!object.contains(key)) return out;
  for (const Json& value : object.at(key)) out.push_back(text_of(value));
  return out;
}

/// The elements of an array, or none.
const Json& list_at(const Json& object, const char* key) {
  static const Json kNone = Json::array();
  return object.contains(key) ? object.at(key) : kNone;
}

FigureSpec figure_of(const Json& json) {
  FigureSpec figure;
  figure.name = text_at(json, "name");
  figure.kind = text_at(json, "kind");
  figure.title = text_at(json, "title", figure.name);
  figure.caption = text_at(json, "caption");
  figure.axis = text_at(json, "axis");
  figure.configurations = texts_at(json, "configurations");
  figure.value = text_at(json, "value", figure.value);
  figure.normalized_to = text_at(json, "normalized_to");
  figure.workloads = texts_at(json, "workloads");
  figure.categories = texts_at(json, "categories");
  figure.by_workload = text_at(json, "by") == "workload";
  for (const Json& point : list_at(json, "published"))
    figure.published.push_back(
        {text_at(point, "x"), text_at(point, "category"), point.at("value").get<double>()});
  return figure;
}

StudySpec spec_of(const Json& json) {
  StudySpec spec;
  spec.name = text_at(json, "name");
  spec.title = text_at(json, "title", spec.name);
  spec.version = text_at(json, "version");
  spec.baseline = text_at(json, "baseline");
  if (json.contains("options"))
    for (const auto& [name, value] : json.at("options").items())
      spec.options.emplace_back(name, text_of(value));
  for (const Json& category : list_at(json, "categories"))
    spec.categories.push_back(
        {text_at(category, "name"), text_at(category, "title", text_at(category, "name"))});
  for (const Json& axis : list_at(json, "axes"))
    spec.axes.push_back({text_at(axis, "name"), text_at(axis, "title"), text_at(axis, "scheme"),
                         text_at(axis, "key"), texts_at(axis, "values"), texts_at(axis, "configurations")});
  for (const Json& figure : list_at(json, "figures")) spec.figures.push_back(figure_of(figure));
  return spec;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> read_render_facts(const std::string& path) {
  constexpr std::pair<const char*, const char*> kFacts[] = {{"renderer", "gl_renderer"},
                                                            {"GL version", "gl_version"}};
  std::vector<std::pair<std::string, std::string>> out;
  const auto document = read_whole_file(path);
  const Json json = document ? Json::parse(*document, nullptr, false) : Json();
  if (!json.is_object()) return out;
  for (const auto& [name, key] : kFacts) {
    std::set<std::string> values;
    for (const Json& workload : list_at(json, "workloads"))
      if (const std::string text = text_at(workload, key); !text.empty()) values.insert(text);
    if (!values.empty()) out.emplace_back(name, fmt::format("{}", fmt::join(values, ", ")));
  }
  return out;
}

Result<StudySpec> read_study_spec(const std::string& path) {
  const auto text = read_whole_file(path);
  if (!text) return Error{ErrorKind::kFile, path + ": cannot be opened"};
  try {
    return spec_of(Json::parse(*text));
  } catch (const Json::exception& fault) {
    return Error{ErrorKind::kFile, path + ": " + fault.what()};
  }
}

}  // namespace tilepress
