// Temporary folder: mkdtemp and remove_all.
#include "temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace tilepress {
namespace {

namespace fs = std::filesystem;
constexpr const char* kSeparators = " :";

}  // namespace

TemporaryFolder::~TemporaryFolder() {
  std::error_code code;
  if (!path_.empty()) fs::remove_all(path_, code);
}

Result<void> TemporaryFolder::create() {
  const char* variable = std::getenv("TMPDIR");
  std::string base = variable != nullptr && variable[0] == '/' ? variable : "/tmp";
  if (base.find_first_of(kSeparators) != std::string::npos) base = "/tmp";
  std::string pattern = base + "/tilepress-XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr)
    return Error{ErrorKind::kFile, base + ": " + std::strerror(errno)};
  path_ = pattern;
  return {};
}

Result<std::string> preloadable(const std::string& library, TemporaryFolder& folder) {
  if (library.find_first_of(kSeparators) == std::string::npos) return library;
  if (folder.path().empty())
    if (const auto created = folder.create(); !created) return created.error();
  // The program may run as another user.
  std::error_code code;
  fs::permissions(folder.path(), fs::perms(0711), code);
  // A link to the whole folder: the library looks for its engine beside itself.
  const fs::path original(library);
  fs::create_directory_symlink(original.parent_path(), folder.path() + "/lib", code);
  return folder.path() + "/lib/" + original.filename().string();
}

}  // namespace tilepress
