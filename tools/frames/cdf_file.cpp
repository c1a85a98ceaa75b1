// CDF file: one write() per frame.
#include "frames/cdf_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common_options.h"
#include "tilepress/color_cdf.h"

namespace tilepress {

void add_cdf_options(CLI::App& app, std::string& path, FrameSet& frames) {
  app.add_option("--cdf", path, "Write every colour of the frames with its count and the cumulative share")
      ->type_name("FILE");
  add_frames_option(app, frames, "cdf-frames", "The frames of the --cdf file, as 0-99,200 (default: every frame)")
      ->needs("--cdf");
}

Result<void> CdfFile::open(const std::string& path, bool force) {
  path_ = path;
  // The file may lie in the run directory, which is not made yet.
  std::error_code ignored;
  if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder, ignored);
  struct stat status {};
  const bool device = stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
  fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (force || device ? O_TRUNC : O_EXCL), 0666);
  if (fd_ < 0 && errno == EEXIST) return Error{ErrorKind::kExists, path + ": exists (--force replaces it)"};
  if (fd_ < 0) return Error{ErrorKind::kFile, path + ": " + std::strerror(errno)};
  auto written = write(color_cdf_header());
  if (!written && !device) unlink(path.c_str());
  return written;
}

Result<void> CdfFile::append(const FrameStatistics& frame, const SurfaceView& view) {
  std::string rows;
  append_color_cdf(frame.frame, frame.surface, view.format, color_counts(view), rows);
  return write(rows);
}

CdfFile::~CdfFile() {
  if (fd_ >= 0) close(fd_);
}

Result<void> CdfFile::write(const std::string& text) {
  const off_t before = lseek(fd_, 0, SEEK_CUR);
  for (size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(fd_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int code = written == 0 ? ENOSPC : errno;
      if (before >= 0 && done > 0 && ftruncate(fd_, before) != 0) { /* `code` says what failed first */
      }
      return Error{ErrorKind::kFile, path_ + ": " + std::strerror(code)};
    }
    done += static_cast<size_t>(written);
  }
  return {};
}

}  // namespace tilepress
