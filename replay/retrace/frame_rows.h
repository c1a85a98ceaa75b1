// Frame rows: how many frames a running shim has finished, by the rows of its growing frames.csv.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tilepress {

/// Folders below `folder` that hold a run.
std::vector<std::string> run_folders_in(const std::string& folder);

class FrameRows {
 public:
  /// `folder`: where the shim makes its run folders.
  explicit FrameRows(std::string folder) : folder_(std::move(folder)) {}
  FrameRows(const FrameRows&) = delete;
  FrameRows& operator=(const FrameRows&) = delete;
  ~FrameRows();

  /// Looks again. True if anything went on since the last look: rows, or counts of frames not taken.
  bool look();
  uint64_t count() const { return lines_ > 0 ? lines_ - 1 : 0; }  ///< without the header

 private:
  std::string folder_, run_folder_;
  int fd_ = -1;
  uint64_t lines_ = 0;
  int64_t json_changed_ns_ = 0;
};

}  // namespace tilepress
