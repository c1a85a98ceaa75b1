// Replaced runs: renamed to PATH.replaced.
#include "capture/replaced_runs.h"

#include <filesystem>

#include "tilepress/run_reader.h"

namespace tilepress {

namespace fs = std::filesystem;

constexpr const char* kAside = ".replaced";

void ReplacedRuns::end() {
  std::error_code code;
  for (const std::string& path : paths_)
    if (fs::exists(path, code))
      fs::remove_all(path + kAside, code);
    else
      fs::rename(path + kAside, path, code);
  paths_.clear();
}

Result<void> ReplacedRuns::set_aside(const std::string& path) {
  std::error_code code;
  fs::remove_all(path + ".partial", code);
  // What a killed `replay --force` left.
  if (!fs::exists(path, code) && fs::exists(path + kAside, code)) fs::rename(path + kAside, path, code);
  if (!fs::exists(path, code)) return {};
  if (!holds_run(path)) return Error{ErrorKind::kFile, path + ": holds no run; --force replaces only runs"};
  fs::remove_all(path + kAside, code);
  fs::rename(path, path + kAside, code);
  if (code) return Error{ErrorKind::kFile, path + ": " + code.message()};
  paths_.push_back(path);
  return {};
}

}  // namespace tilepress
