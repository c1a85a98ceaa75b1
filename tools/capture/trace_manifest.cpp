// Trace manifest: toml++ reads, every key is checked.
#include "capture/trace_manifest.h"

#include <filesystem>

#define TOML_EXCEPTIONS 1
#include <toml++/toml.h>

namespace tilepress {
namespace {

namespace fs = std::filesystem;

/// Thrown and caught in this file.
struct ManifestFault {
  toml::source_region where;
  std::string reason;
};

std::string take_text(const toml::table& entry, const char* key) {
  const toml::node* node = entry.get(key);
  if (node == nullptr) return {};
  const auto text = node->value_exact<std::string>();
  if (!text || text->empty()) throw ManifestFault{node->source(), std::string(key) + " is no text"};
  return *text;
}

void check_keys(const toml::table& table, std::initializer_list<std::string_view> known) {
  for (const auto& [key, node] : table)
    if (std::find(known.begin(), known.end(), key.str()) == known.end())
      throw ManifestFault{node.source(), "unknown key '" + std::string(key.str()) + "'"};
}

ReplayInput take_entry(const toml::table& entry, const fs::path& folder) {
  check_keys(entry, {"path", "name", "sha256", "category", "frames"});
  const auto fault = [&entry](const char* key, const std::string& reason) {
    return ManifestFault{entry.get(key) != nullptr ? entry.get(key)->source() : entry.source(), reason};
  };
  ReplayInput input;
  input.path = take_text(entry, "path");
  if (input.path.empty()) throw fault("path", "a trace without path");
  input.path = (folder / input.path).lexically_normal().string();
  input.name = take_text(entry, "name");
  if (input.name.empty()) input.name = replay_name(input.path);
  if (input.name.find('/') != std::string::npos || input.name.starts_with("."))
    throw fault("name", "'" + input.name + "' cannot name a folder");
  input.sha256 = take_text(entry, "sha256");
  if (!input.sha256.empty() &&
      (input.sha256.size() != 64 || input.sha256.find_first_not_of("0123456789abcdef") != std::string::npos))
    throw fault("sha256", "sha256 is not 64 digits 0-9a-f");
  input.category = take_text(entry, "category");
  if (!input.category.empty() && input.category != "UI" && input.category != "2D" && input.category != "3D")
    throw fault("category", "category '" + input.category + "' is none of UI, 2D, 3D");
  if (const std::string frames = take_text(entry, "frames"); !frames.empty()) {
    const auto parsed = FrameSet::parse(frames);
    if (!parsed) throw fault("frames", "frames: " + parsed.error().text);
    input.frames = *parsed;
  }
  return input;
}

}  // namespace

std::string replay_name(const std::string& trace_path) {
  const fs::path file = fs::path(trace_path).filename();
  return (file.extension() == ".trace" ? file.stem() : file).string();
}

bool read_manifest(const std::string& path, std::vector<ReplayInput>& inputs, std::string& error) {
  try {
    const toml::table table = toml::parse_file(path);
    check_keys(table, {"trace"});
    const toml::node* node = table.get("trace");
    const toml::array* list = node != nullptr ? node->as_array() : nullptr;
    if (list == nullptr || list->empty()) throw ManifestFault{table.source(), "lists no [[trace]]"};
    for (const toml::node& entry : *list) {
      if (!entry.is_table()) throw ManifestFault{entry.source(), "trace is no table"};
      inputs.push_back(take_entry(*entry.as_table(), fs::path(path).parent_path()));
    }
    return true;
  } catch (const toml::parse_error& fault) {
    const auto line = fault.source().begin.line;
    error =
        path + (line > 0 ? ": line " + std::to_string(line) : "") + ": " + std::string(fault.description());
  } catch (const ManifestFault& fault) {
    error = path + ": line " + std::to_string(fault.where.begin.line) + ": " + fault.reason;
  }
  return false;
}

}  // namespace tilepress
