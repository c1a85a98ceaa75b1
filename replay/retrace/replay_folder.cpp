// Replay folder: one thread at a time makes and removes folders.
#include "replay_folder.h"

#include <filesystem>
#include <mutex>

namespace tilepress {

namespace fs = std::filesystem;

static std::mutex shared_parents;

bool ReplayFolder::exists() const {
  std::error_code code;
  return fs::exists(partial_path_, code) || fs::exists(run_path_, code);
}

Result<void> ReplayFolder::make() {
  const std::lock_guard lock(shared_parents);
  std::error_code code;
  for (fs::path path = output_; path.has_relative_path() && !fs::exists(path, code);
       path = path.parent_path())
    made_parents_.push_back(path.string());
  fs::create_directories(output_, code);
  if (!code && !fs::create_directory(partial_path_, code) && !code)
    code = std::make_error_code(std::errc::file_exists);
  if (!code) return {};
  return Error{code == std::errc::file_exists ? ErrorKind::kExists : ErrorKind::kFile,
               partial_path_ + ": " + code.message()};
}

void ReplayFolder::remove(bool with_parents) {
  const std::lock_guard lock(shared_parents);
  std::error_code code;
  fs::remove_all(partial_path_, code);
  for (const std::string& path : made_parents_)
    if (!with_parents || !fs::remove(path, code)) return;
}

}  // namespace tilepress
