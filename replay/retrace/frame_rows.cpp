// Frame rows: counts line ends as they arrive.
#include "frame_rows.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tilepress/run_reader.h"

namespace tilepress {

std::vector<std::string> run_folders_in(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code))
    if (holds_run(entry.path().string())) found.push_back(entry.path().string());
  std::sort(found.begin(), found.end());
  return found;
}

FrameRows::~FrameRows() {
  if (fd_ >= 0) close(fd_);
}

bool FrameRows::look() {
  if (fd_ < 0) {
    const std::vector<std::string> folders = run_folders_in(folder_);
    if (folders.empty()) return false;
    run_folder_ = folders.front();
    fd_ = open((run_folder_ + "/frames.csv").c_str(), O_RDONLY | O_CLOEXEC);
    if (fd_ < 0) return false;
  }
  const uint64_t before = lines_;
  char buffer[1 << 14];
  for (ssize_t got = 0; (got = read(fd_, buffer, sizeof buffer)) > 0;)
    lines_ += static_cast<uint64_t>(std::count(buffer, buffer + got, '\n'));
  // The shim replaces run.json while it skips frames.
  struct stat json {};
  int64_t changed_ns = json_changed_ns_;
  if (stat((run_folder_ + "/run.json").c_str(), &json) == 0)
    changed_ns = json.st_mtim.tv_sec * 1'000'000'000 + json.st_mtim.tv_nsec;
  const bool moved = lines_ != before || changed_ns != json_changed_ns_;
  json_changed_ns_ = changed_ns;
  return moved;
}

}  // namespace tilepress
