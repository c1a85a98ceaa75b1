// Invocation: a JSON object.
#include "invocation.h"

#include <nlohmann/json.hpp>

#include "study/text_file.h"
#include "tilepress/run_option_table.h"
#include "tilepress/whole_file.h"

namespace tilepress {
namespace {

/// The options of a run that a study keeps.
constexpr const char* kRunOptions[] = {"tile", "burst", "frames", "every"};

nlohmann::ordered_json to_json(const StudyOptions& options) {
  nlohmann::ordered_json json;
  json["study"] = options.study;
  json["inputs"] = options.inputs;
  json["trace_folder"] = options.trace_folder;
  json["categories"] = options.categories;
  for (const char* name : kRunOptions) json["options"][name] = find_run_option(name)->text.print(options.run);
  if (const auto plugins = find_run_option("plugin")->text.print(options.run); !plugins.empty())
    json["options"]["plugin"] = plugins;
  json["chunk"] = options.chunk;
  json["bounds"] = options.bounds;
  json["cache"] = options.render.cache_folder;
  json["cache_bytes"] = options.render.size_limit_bytes;
  json["retracer"] = static_cast<int>(options.render.retracer);
  json["display"] = static_cast<int>(options.render.display);
  json["timeout_s"] = options.render.timeout.count();
  return json;
}

StudyOptions from_json(const nlohmann::json& json) {
  StudyOptions options;
  json.at("inputs").get_to(options.inputs);
  options.trace_folder = json.value("trace_folder", "");
  json.at("categories").get_to(options.categories);
  for (const char* name : kRunOptions) {
    const auto text = json.at("options").at(name).get<std::string>();
    if (!text.empty() && !set_run_option(options.run, name, text)) continue;  // of another version
  }
  json.at("chunk").get_to(options.chunk);
  options.bounds = json.value("bounds", false);
  json.at("cache").get_to(options.render.cache_folder);
  json.at("cache_bytes").get_to(options.render.size_limit_bytes);
  options.render.retracer = static_cast<RetracerChoice>(json.at("retracer").get<int>());
  options.render.display = static_cast<ReplayDisplay>(json.at("display").get<int>());
  options.render.timeout = std::chrono::seconds(json.at("timeout_s").get<int64_t>());
  return options;
}

}  // namespace

Result<void> store_invocation(const StudyOptions& options, const std::string& study_text) {
  const auto stored = store_text_file(options.folder + "/study.toml", study_text);
  if (!stored) return stored;
  return store_text_file(options.folder + "/invocation.json", to_json(options).dump(2) + "\n");
}

Result<StudyOptions> load_invocation(const std::string& folder) {
  const std::string path = folder + "/invocation.json";
  const auto text = read_whole_file(path);
  if (!text) return Error{ErrorKind::kFile, folder + ": holds no study (no invocation.json)"};
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  try {
    StudyOptions options = from_json(json);
    const std::string plugins = json.at("options").value("plugin", "");
    if (const auto loaded = set_run_option(options.run, "plugin", plugins); !loaded)
      return about(path, loaded.error());
    options.study = folder + "/study.toml";
    options.folder = folder;
    return options;
  } catch (const nlohmann::json::exception& error) {
    return Error{ErrorKind::kFile, path + ": " + error.what()};
  }
}

}  // namespace tilepress
