// Shim path: relative to /proc/self/exe, so that an installed tree may be moved.
#include "capture/shim_path.h"

#include <filesystem>

namespace tilepress {

std::optional<std::string> find_shim(const std::string& library, std::string& looked) {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::path self = fs::read_symlink("/proc/self/exe", code);
  const fs::path prefix = self.parent_path().parent_path();
  for (const char* folder : {"lib", "lib/tilepress", "interposer"}) {
    const fs::path candidate = prefix / folder / library;
    if (fs::is_regular_file(candidate, code)) return candidate.string();
    looked += (looked.empty() ? "" : ", ") + candidate.string();
  }
  return std::nullopt;
}

}  // namespace tilepress
