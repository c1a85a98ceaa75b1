// Running captures: each has a live page in its folder.
#include "live/running_captures.h"

#include <algorithm>
#include <filesystem>

#include "tilepress/live_page.h"
#include "tilepress/run_lock.h"

namespace tilepress {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 4;

static void look(const fs::path& folder, int depth, std::vector<std::string>& out) {
  std::error_code code;
  if (fs::exists(folder / kLiveFile, code)) {
    out.push_back(folder.string());
    return;
  }
  if (depth == kMaxDepth) return;
  for (auto entry = fs::directory_iterator(folder, code); !code && entry != fs::directory_iterator();
       entry.increment(code))
    if (std::error_code kind; entry->is_directory(kind) && !entry->is_symlink(kind))
      look(entry->path(), depth + 1, out);
}

std::vector<std::string> find_running_captures(const std::vector<std::string>& folders) {
  std::vector<std::string> out;
  for (const std::string& folder : folders) look(folder, 0, out);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

bool capture_runs(const std::string& run_path) {
  std::error_code code;
  return fs::exists(fs::path(run_path) / kLiveFile, code) && run_is_written(run_path);
}

}  // namespace tilepress
