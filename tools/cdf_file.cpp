// CDF file: rows are flushed frame by frame.
#include "cdf_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "tilepress/color_cdf.h"

namespace tilepress {

void add_cdf_options(CLI::App& app, std::string& path, FrameSet& frames) {
  app.add_option("--cdf", path, "Write every colour of the frames with its count and the cumulative share")
      ->type_name("FILE");
  app.add_option_function<std::string>(
         "--cdf-frames",
         [&frames](const std::string& text) {
           std::string error;
           const auto parsed = FrameSet::parse(text, error);
           if (!parsed) throw CLI::ValidationError("--cdf-frames " + text + ": " + error);
           frames = *parsed;
         },
         "Of these frames only, as 0-99,200 (default: every frame)")
      ->type_name("RANGES")
      ->needs("--cdf");
}

bool CdfFile::open(const std::string& path, bool force, std::string& error) {
  path_ = path;
  // It may lie in the run directory, which is not there yet.
  std::error_code ignored;
  if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder, ignored);
  file_.reset(std::fopen(path.c_str(), force ? "w" : "wx"));
  if (!file_) {
    error = path + ": " + (errno == EEXIST ? "exists (--force replaces it)" : std::strerror(errno));
    return false;
  }
  return write(color_cdf_header(), error);
}

bool CdfFile::append(const FrameStatistics& frame, const SurfaceView& view, std::string& error) {
  std::string rows;
  append_color_cdf(frame.frame, frame.surface, view.format, color_counts(view), rows);
  return write(rows, error);
}

bool CdfFile::write(const std::string& text, std::string& error) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size() && std::fflush(file_.get()) == 0)
    return true;
  error = path_ + ": " + std::strerror(errno);
  return false;
}

}  // namespace tilepress
