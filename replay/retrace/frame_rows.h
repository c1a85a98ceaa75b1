// Frame rows: counts the frames that a running shim has finished, by the rows of its frames.csv.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tilepress {

/// Returns the folders below `folder` that hold a run, sorted.
std::vector<std::string> run_folders_in(const std::string& folder);

class FrameRows {
 public:
  /// `folder`: where the shim makes its run folders.
  explicit FrameRows(std::string folder) : folder_(std::move(folder)) {}
  FrameRows(const FrameRows&) = delete;
  FrameRows& operator=(const FrameRows&) = delete;
  ~FrameRows();

  /// Looks again. Returns true if rows, or counts of frames not taken, are new since the last look.
  bool look();
  uint64_t count() const { return lines_ > 0 ? lines_ - 1 : 0; }  ///< without the header

 private:
  std::string folder_, run_folder_;
  int fd_ = -1;
  uint64_t lines_ = 0;
  int64_t json_changed_ns_ = 0;
};

}  // namespace tilepress
