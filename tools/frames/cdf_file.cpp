// CDF file: one write() a frame.
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
  add_frames_option(app, frames, "cdf-frames", "Of these frames only, as 0-99,200 (default: every frame)")
      ->needs("--cdf");
}

bool CdfFile::open(const std::string& path, bool force, std::string& error) {
  path_ = path;
  // It may lie in the run directory, which is not there yet.
  std::error_code ignored;
  if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder, ignored);
  struct stat status {};
  const bool device = stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
  fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (force || device ? O_TRUNC : O_EXCL), 0666);
  if (fd_ < 0) {
    error = path + ": " + (errno == EEXIST ? "exists (--force replaces it)" : std::strerror(errno));
    return false;
  }
  if (write(color_cdf_header(), error)) return true;
  if (!device) unlink(path.c_str());
  return false;
}

bool CdfFile::append(const FrameStatistics& frame, const SurfaceView& view, std::string& error) {
  std::string rows;
  append_color_cdf(frame.frame, frame.surface, view.format, color_counts(view), rows);
  return write(rows, error);
}

CdfFile::~CdfFile() {
  if (fd_ >= 0) close(fd_);
}

bool CdfFile::write(const std::string& text, std::string& error) {
  const off_t before = lseek(fd_, 0, SEEK_CUR);
  for (size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(fd_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      error = path_ + ": " + std::strerror(written == 0 ? ENOSPC : errno);
      if (before >= 0 && done > 0 && ftruncate(fd_, before) != 0) { /* the error is told as it is */
      }
      return false;
    }
    done += static_cast<size_t>(written);
  }
  return true;
}

}  // namespace tilepress
