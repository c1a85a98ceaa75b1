// Shim path: relative to /proc/self/exe, so that an installed tree may be moved.
#include "capture/shim_path.h"

#include <filesystem>

namespace tilepress {

Result<std::string> find_shim(const std::string& part) {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::path self = fs::read_symlink("/proc/self/exe", code);
  const fs::path prefix = self.parent_path().parent_path();
  std::string looked;
  for (const char* folder : {"lib", "lib/tilepress", "interposer"}) {
    const fs::path candidate = prefix / folder / part;
    if (fs::is_regular_file(candidate, code)) return candidate.string();
    looked += (looked.empty() ? "" : ", ") + candidate.string();
  }
  return Error{ErrorKind::kFile, part + ": not found (looked at " + looked + ")"};
}

}  // namespace tilepress
