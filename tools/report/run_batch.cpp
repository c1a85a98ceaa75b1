// Run batch: the folder walk and the workload names.
#include "run_batch.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "input_kind.h"
#include "tilepress/whole_file.h"
#include "way_out.h"

namespace tilepress {
namespace fs = std::filesystem;
namespace {

bool is_run(const fs::path& path) {
  std::error_code code;
  return fs::exists(path / "frames.csv", code) || fs::exists(path / "schemes.csv", code);
}

void collect(const fs::path& path, std::vector<std::string>& out) {
  if (is_run(path)) {
    out.push_back(path.string());
    return;
  }
  std::vector<fs::path> folders;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(path, code))
    if (entry.is_directory(code) && !entry.is_symlink(code)) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  for (const fs::path& folder : folders) collect(folder, out);
}

/// The folder's name without the "-<pid>" that `run` puts behind a program's name.
std::string without_pid(const std::string& folder) {
  const size_t dash = folder.find_last_of('-');
  const bool process = dash != std::string::npos && dash > 0 && dash + 1 < folder.size() &&
                       folder.find_first_not_of("0123456789", dash + 1) == std::string::npos;
  return process ? folder.substr(0, dash) : folder;
}

std::string folder_name(const std::string& path) {
  fs::path full = fs::absolute(path).lexically_normal();
  if (!full.has_filename()) full = full.parent_path();
  return full.filename().string();
}

/// The name that --name gave the run, or that of its folder.
std::string plain_name(const std::string& path) {
  const auto json = run_document(path);
  const auto name = json.find("name");
  const bool named = name != json.end() && name->is_string() && *name != "";
  return named ? name->get<std::string>() : without_pid(folder_name(path));
}

}  // namespace

Result<std::vector<BatchEntry>> find_runs(const std::vector<std::string>& paths) {
  std::vector<std::string> found;
  for (const std::string& path : paths) {
    std::error_code code;
    if (!fs::is_directory(path, code))
      return Error{ErrorKind::kFile,
                   path + (fs::exists(path, code) ? ": not a run directory" + verb_hint(path, "report")
                                                  : ": no such folder" + path_hint(path))};
    const size_t before = found.size();
    collect(path, found);
    if (found.size() == before)
      return Error{ErrorKind::kFile,
                   path + ": holds no run (no frames.csv in it or below)" + verb_hint(path, "report")};
  }
  std::vector<std::string> plain;
  for (const std::string& path : found) plain.push_back(plain_name(path));
  std::map<std::string, size_t> plain_count, folder_count;
  for (size_t i = 0; i < found.size(); ++i) {
    ++plain_count[plain[i]];
    ++folder_count[folder_name(found[i])];
  }
  std::vector<BatchEntry> entries;
  for (size_t i = 0; i < found.size(); ++i) {
    const std::string folder = folder_name(found[i]);
    if (plain_count[plain[i]] == 1)
      entries.push_back({found[i], plain[i]});
    else
      entries.push_back({found[i], folder_count[folder] == 1 ? folder : found[i]});
  }
  return entries;
}

nlohmann::json run_document(const std::string& path) {
  const auto text = read_whole_file(path + "/run.json");
  auto json = nlohmann::json::parse(text ? *text : "", nullptr, false);
  return json.is_object() ? json : nlohmann::json::object();
}

std::vector<std::string> names_of(const std::vector<BatchEntry>& entries) {
  std::vector<std::string> names;
  for (const BatchEntry& entry : entries) names.push_back(entry.name);
  return names;
}

std::string workload_category(const RunRecord& run) {
  for (const auto& [name, value] : run.info.further)
    if (name == "category") return value;
  return "";
}

}  // namespace tilepress
