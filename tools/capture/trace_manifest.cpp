// Trace manifest: toml++ reads the file, and every key is checked.
#include "capture/trace_manifest.h"

#include <filesystem>

#include "capture/mesa_manifest.h"
#include "tilepress/nearest_word.h"
#include "toml_text.h"
#include "way_out.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

/// Copies the values of `entry`, which are all texts, to the places of their keys.
Result<void> take_texts(const toml::table& entry, const std::map<std::string_view, std::string*>& places) {
  for (const auto& [key, node] : entry) {
    const auto place = places.find(key.str());
    if (place == places.end()) {
      std::vector<std::string_view> known;
      for (const auto& each : places) known.push_back(each.first);
      return at_line(node, "unknown key '" + std::string(key.str()) + "'" + nearest_hint(key.str(), known));
    }
    const auto text = node.value_exact<std::string>();
    if (!text || text->empty()) return at_line(node, std::string(key.str()) + " is no text");
    *place->second = *text;
  }
  return {};
}

Result<ReplayInput> take_entry(const toml::table& entry, const fs::path& folder) {
  ReplayInput input;
  std::string frames;
  const auto taken = take_texts(entry, {{"path", &input.path},
                                        {"name", &input.name},
                                        {"sha256", &input.sha256},
                                        {"category", &input.category},
                                        {"frames", &frames}});
  if (!taken) return taken.error();
  const auto fault = [&entry](const char* key, const std::string& reason) {
    const toml::node* node = entry.get(key);
    return at_line(node != nullptr ? *node : entry, reason);
  };
  if (input.path.empty()) return fault("path", "a trace without path");
  input.path = (folder / input.path).lexically_normal().string();
  if (input.name.empty()) input.name = replay_name(input.path);
  if (input.name.find('/') != std::string::npos || input.name.starts_with("."))
    return fault("name", "'" + input.name + "' cannot name a folder");
  if (!input.sha256.empty() &&
      (input.sha256.size() != 64 || input.sha256.find_first_not_of("0123456789abcdef") != std::string::npos))
    return fault("sha256", "sha256 is not 64 digits 0-9a-f");
  if (!input.category.empty() && input.category != "UI" && input.category != "2D" && input.category != "3D")
    return fault("category", "category '" + input.category + "' is none of UI, 2D, 3D");
  if (frames.empty()) return input;
  const auto parsed = FrameSet::parse(frames);
  if (!parsed) return fault("frames", "frames: " + parsed.error().text);
  input.frames = *parsed;
  return input;
}

Result<std::vector<ReplayInput>> take_all(const toml::table& table, const fs::path& folder) {
  constexpr std::string_view kKeys[] = {"trace"};
  for (const auto& [key, node] : table)
    if (key.str() != kKeys[0])
      return at_line(node, "unknown key '" + std::string(key.str()) + "'" +
                               nearest_hint(key.str(), kKeys, "a manifest has [[trace]] tables"));
  const toml::array* list = table.get_as<toml::array>("trace");
  if (list == nullptr || list->empty()) return at_line(table, "lists no [[trace]]");
  std::vector<ReplayInput> inputs;
  for (const toml::node& entry : *list) {
    if (!entry.is_table()) return at_line(entry, "trace is no table");
    const auto input = take_entry(*entry.as_table(), folder);
    if (!input) return input.error();
    inputs.push_back(*input);
  }
  return inputs;
}

}  // namespace

std::string replay_name(const std::string& trace_path) {
  const fs::path file = fs::path(trace_path).filename();
  return (file.extension() == ".trace" ? file.stem() : file).string();
}

Result<std::vector<ReplayInput>> read_manifest(const std::string& path, const std::string& trace_folder) {
  if (!missing_paths({path}).empty()) return Error{ErrorKind::kFile, missing_text(path)};
  if (is_mesa_manifest(path)) return read_mesa_manifest(path, trace_folder);
  const auto table = parse_toml([&] { return toml::parse_file(path); });
  if (!table) return about(path, table.error());
  auto inputs = take_all(*table, fs::path(path).parent_path());
  if (!inputs) return about(path, inputs.error());
  return inputs;
}

}  // namespace tilepress
