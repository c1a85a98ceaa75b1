// CDF file: the colour CDF of frames as CSV.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "tilepress/run_options.h"
#include "tilepress/statistics.h"
#include "tilepress/surface.h"

namespace tilepress {

/// Adds --cdf and --cdf-frames.
void add_cdf_options(CLI::App& app, std::string& path, FrameSet& frames);

class CdfFile {
 public:
  CdfFile() = default;
  CdfFile(const CdfFile&) = delete;
  CdfFile& operator=(const CdfFile&) = delete;
  ~CdfFile();
  /// Creates the file and its folder, and writes the header row. Fails with kExists if the file exists and
  /// `force` is false.
  Result<void> open(const std::string& path, bool force);
  /// Adds a row per colour of `view`, the pixels of `frame`.
  Result<void> append(const FrameStatistics& frame, const SurfaceView& view);

 private:
  /// Writes all of `text` or nothing.
  Result<void> write(const std::string& text);
  std::string path_;
  int fd_ = -1;
};

}  // namespace tilepress
