// Mesa manifest: yaml-cpp reads the file.
#include "capture/mesa_manifest.h"

#include <yaml-cpp/yaml.h>

#include <cctype>
#include <filesystem>
#include <set>

namespace tilepress {
namespace {

namespace fs = std::filesystem;

Error at_mark(const YAML::Mark& mark, const std::string& reason) {
  const std::string line = mark.is_null() ? "" : "line " + std::to_string(mark.line + 1) + ": ";
  return {ErrorKind::kBadValue, line + reason};
}

/// The path of an entry: a text in itself, or the value of its key `path`.
Result<std::string> path_of(const YAML::Node& entry) {
  const YAML::Node path = entry.IsMap() ? entry["path"] : entry;
  if (!path || !path.IsScalar() || path.Scalar().empty())
    return at_mark(entry.Mark(), "a trace without path");
  const fs::path relative = fs::path(path.Scalar()).lexically_normal();
  if (relative.is_absolute() || *relative.begin() == "..")
    return at_mark(path.Mark(), "'" + path.Scalar() + "' leaves the folder of the traces");
  return relative.string();
}

Result<std::vector<std::string>> take_paths(const YAML::Node& root) {
  if (!root.IsMap()) return Error{ErrorKind::kBadValue, "has no key 'traces'"};
  const YAML::Node traces = root["traces"];
  if (!traces) return Error{ErrorKind::kBadValue, "has no key 'traces'"};
  if (!traces.IsMap() && !traces.IsSequence())
    return at_mark(traces.Mark(), "traces is no list and no mapping");
  std::vector<std::string> paths;
  std::set<std::string> seen;
  for (const auto& item : traces) {
    const auto path = path_of(traces.IsMap() ? item.first : YAML::Node(item));
    if (!path) return path.error();
    if (seen.insert(*path).second) paths.push_back(*path);
  }
  if (paths.empty()) return at_mark(traces.Mark(), "lists no trace");
  return paths;
}

}  // namespace

std::string plain_file_name(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                       std::string_view("._-+=").find(c) != std::string_view::npos;
    out += plain ? c : '_';
  }
  return out.empty() || out[0] == '.' ? "_" + out : out;
}

bool is_mesa_manifest(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  return extension == ".yml" || extension == ".yaml";
}

Result<std::vector<ReplayInput>> read_mesa_manifest(const std::string& path,
                                                    const std::string& trace_folder) {
  Result<std::vector<std::string>> listed = std::vector<std::string>{};
  try {
    listed = take_paths(YAML::LoadFile(path));
  } catch (const YAML::BadFile&) {
    return Error{ErrorKind::kFile, path + ": cannot be read"};
  } catch (const YAML::Exception& error) {
    listed = at_mark(error.mark, error.msg);
  }
  if (!listed) return about(path, listed.error());
  const fs::path folder = trace_folder.empty() ? fs::path(path).parent_path() : fs::path(trace_folder);
  std::vector<ReplayInput> inputs;
  for (const std::string& trace : *listed) {
    std::string name = fs::path(trace).replace_extension().string();
    for (char& c : name)
      if (c == '/') c = '-';
    inputs.push_back({(folder / trace).string(), plain_file_name(name), "", "", std::nullopt});
  }
  return inputs;
}

}  // namespace tilepress
