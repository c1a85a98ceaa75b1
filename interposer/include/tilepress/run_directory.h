// Run directory: frames.csv, schemes.csv and run.json of one run. A kill loses no finished frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/append_file.h"
#include "tilepress/result.h"
#include "tilepress/run_info.h"
#include "tilepress/run_options.h"
#include "tilepress/run_reader.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// Writes one run. Each frame is one write() per file, so that a SIGKILL loses no finished frame. The rows of
/// schemes.csv come first: a row in frames.csv means that the frame is complete. run.json is replaced
/// atomically at creation ("state": "running"), at most twice a second, and by finish(). The destructor
/// closes the files without finish(). Not thread-safe.
class RunWriter {
 public:
  /// Creates `path` (parents too) and the three files. kExists: `path` already holds a run.
  Result<void> create(const std::string& path, const RunInfo& info, const RunOptions& options);
  Result<void> append(const FrameStatistics& frame);
  /// May be called at any time; run.json follows within half a second or at finish().
  void set_counts(const RunCounts& counts, const RunCounts& targets = {});
  void set_info(const RunInfo& info) { record_.info = info; }
  /// The captured program has ended. Only this writer still works on the run (run_lock.h).
  void program_has_ended() { frames_.release_lock_of_program(); }
  /// state: "finished", or "failed" with the reason.
  Result<void> finish(const std::string& state, const std::string& reason);

  bool is_open() const { return frames_.is_open(); }
  const std::string& path() const { return record_.path; }
  /// Sums over the presented frames that are not warmup, in the order of the schemes.
  const std::vector<SchemeStatistics>& totals() const { return record_.totals; }

 private:
  Result<void> write_json(const std::string& state, const std::string& reason);
  RunRecord record_;  ///< without frames
  RunOptions options_;
  AppendFile frames_, schemes_;
  uint64_t last_json_ns_ = 0;
  std::string row_buffer_;
};

}  // namespace tilepress
