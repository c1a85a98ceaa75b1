// Run reader: a run directory as it is read back, and its repair where the program was killed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tilepress/run_info.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// A run: read back, or while it is written.
struct RunRecord {
  std::string path;
  /// From run.json: "running", "finished", "failed", "killed by signal 9", or "ended": the program ended
  /// without exit() and its writer finished the run.
  std::string state = "running";
  std::string reason;
  std::string started;  ///< UTC, ISO 8601; empty if unknown
  RunInfo info;
  RunCounts counts, target_counts;
  uint64_t burst_bits = 128;
  std::vector<std::string> scheme_names;  ///< in the order of the run's options
  /// Complete frames in file order; schemes in the order of scheme_names.
  std::vector<FrameStatistics> frames;
  /// Sums over the presented frames that are not warmup, in the order of scheme_names.
  std::vector<SchemeStatistics> totals;
  uint64_t measured_frames = 0;  ///< presented frames that are not warmup
  /// The same for targets (run_info.h).
  std::vector<SchemeStatistics> target_totals;
  uint64_t measured_targets = 0;
  /// Bytes of frames.csv and schemes.csv that hold these frames. Incomplete rows follow them.
  uint64_t frames_bytes = 0, schemes_bytes = 0;

  /// Sets the sums to zero, in the first form with the schemes and the burst of a new run.
  void begin_sums(const RunOptions& options);
  void begin_sums();
  /// Adds a frame to the sums, unless it is warmup.
  void add_to_sums(const FrameStatistics& frame);
  /// How many of `frames` are presented. The others are targets.
  uint64_t presented_frames() const {
    return static_cast<uint64_t>(
        std::count_if(frames.begin(), frames.end(),
                      [](const FrameStatistics& frame) { return !is_target(frame.surface); }));
  }
};

/// True if `path` holds any file of a run.
bool holds_run(const std::string& path);

/// Reads the run in folder `path`. A row that is still being written, and rows of a frame that is not
/// complete, are left out. Columns are found by name; unknown columns are skipped. run.json may be missing.
/// Fails if the folder holds no run or a file is malformed: "path/file: reason".
Result<RunRecord> read_run(const std::string& path);

/// How the program of a run ended.
struct RunEnd {
  std::string state = "finished";
  std::string reason;
  std::optional<int> exit_status;
  std::optional<int> signal;
  bool overrules = false;                                    ///< use state and reason whatever run.json says
  std::string program, via;                                  ///< replace those of run.json, unless empty
  std::vector<std::pair<std::string, std::string>> further;  ///< more string members for run.json
  std::vector<std::pair<std::string, uint64_t>> figures;     ///< more integer members for run.json
};

/// Closes a run whose program has ended. Cuts off a torn last row and the rows of an incomplete frame, and
/// replaces run.json by one with totals over the complete frames. Presented frames without a row count as not
/// captured. The state in run.json stays if it is "failed", or "finished" and no signal ended the program;
/// `end.overrules` replaces any state. `record` comes from read_run() and becomes the closed run.
Result<void> close_run(const RunEnd& end, RunRecord& record);

}  // namespace tilepress
