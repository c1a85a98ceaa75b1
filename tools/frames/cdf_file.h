// CDF file: the colour CDF of frames as CSV.
#pragma once

#include <CLI/CLI.hpp>
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
  /// Creates the file and writes the header row. An existing file is replaced only with `force`. False and
  /// one line in `error`.
  bool open(const std::string& path, bool force, std::string& error);
  bool is_open() const { return fd_ >= 0; }
  /// Adds a row per colour of `view`, the pixels of `frame`. False and one line in `error`.
  bool append(const FrameStatistics& frame, const SurfaceView& view, std::string& error);

 private:
  /// All of `text` or nothing: what a full disk lets through is cut off again.
  bool write(const std::string& text, std::string& error);
  std::string path_;
  int fd_ = -1;
};

}  // namespace tilepress
