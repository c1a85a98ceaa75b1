// Output folder: made with its parents.
#include "capture/output_folder.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace tilepress {

namespace fs = std::filesystem;

std::string absolute_folder(const std::string& folder) {
  std::error_code code;
  const fs::path path = fs::absolute(folder, code).lexically_normal();
  return path.has_filename() ? path.string() : path.parent_path().string();
}

OutputFolder::~OutputFolder() {
  std::error_code code;
  if (made_) fs::remove(path_, code);
}

Result<void> OutputFolder::prepare(const std::string& path) {
  path_ = path;
  std::error_code code;
  made_ = fs::create_directories(path, code);
  if (!code && !fs::is_directory(path, code)) code = std::make_error_code(std::errc::not_a_directory);
  if (!code && access(path.c_str(), W_OK | X_OK) != 0) code = std::error_code(errno, std::generic_category());
  if (code) return Error{ErrorKind::kFile, path + ": " + code.message()};
  return {};
}

}  // namespace tilepress
