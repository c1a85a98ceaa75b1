// Run directory: frames.csv, schemes.csv and run.json of one run. A kill loses no finished frame.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tilepress/result.h"
#include "tilepress/run_info.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"

namespace tilepress {

class AppendFile;

/// Writes one run. Each frame is one write() per file, so that a SIGKILL loses no finished frame. The rows of
/// schemes.csv come first: a row in frames.csv means that the frame is complete. run.json is replaced
/// atomically at creation ("state": "running"), at most twice a second, and by finish(). Not thread-safe.
class RunWriter {
 public:
  RunWriter();
  RunWriter(const RunWriter&) = delete;
  RunWriter& operator=(const RunWriter&) = delete;
  ~RunWriter();  ///< closes the files without finish()

  /// Creates `path` (parents too) and the three files. kExists: `path` already holds a run.
  Result<void> create(const std::string& path, const RunInfo& info, const RunOptions& options);
  Result<void> append(const FrameStatistics& frame);
  /// May be called at any time; run.json follows within half a second or at finish().
  void set_counts(const RunCounts& counts, const RunCounts& targets = {});
  void set_info(const RunInfo& info);
  /// The captured program has ended. Only this writer still works on the run (run_lock.h).
  void program_has_ended();
  /// state: "finished", or "failed" with the reason.
  Result<void> finish(const std::string& state, const std::string& reason);

  bool is_open() const;
  const std::string& path() const { return path_; }
  /// Sums over the presented frames that are not warmup, in the order of the schemes.
  const std::vector<SchemeStatistics>& totals() const { return totals_; }

 private:
  Result<void> write_json(const std::string& state, const std::string& reason);
  std::string path_, started_;
  RunInfo info_;
  RunOptions options_;
  RunCounts counts_, target_counts_;
  std::vector<std::string> scheme_names_;
  std::vector<SchemeStatistics> totals_, target_totals_;
  uint64_t measured_frames_ = 0, measured_targets_ = 0;
  std::unique_ptr<AppendFile> frames_, schemes_;
  uint64_t last_json_ns_ = 0;
  std::string row_buffer_;
};

}  // namespace tilepress
