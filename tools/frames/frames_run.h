// Frames run: passes all frames of a sequence through the model, writes their rows, and adds them up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "frames/cdf_file.h"
#include "frames/image_frames.h"
#include "memory_trace/trace_options.h"
#include "progress_line.h"
#include "temporary_folder.h"
#include "tilepress/block_log.h"
#include "tilepress/run_directory.h"
#include "tilepress/run_reader.h"
#include "workload_options.h"

namespace tilepress {

/// The options of `tilepress frames`.
struct FramesOptions {
  RunOptions run;
  std::vector<std::string> images;
  std::optional<FrameSize> size;
  ProgressMode progress = ProgressMode::kAuto;
  uint32_t jobs = 1;
  WorkloadLabel workload;
  std::string cdf_path;  ///< empty: no CDF file
  FrameSet cdf_frames;
  MemoryTraceOptions trace;
  bool force = false;
  bool quiet = false;
  bool wants_cdf(uint64_t frame) const { return !cdf_path.empty() && cdf_frames.contains(frame); }
  bool to_stdout() const { return run.output == "-"; }
};

/// Where the rows go: a run directory or standard output.
class RowSink {
 public:
  /// `options.output` is the run directory, or "-" for schemes.csv on standard output. With `force` the run
  /// in the directory is replaced.
  Result<void> open(const RunOptions& options, const RunInfo& info, bool force);
  Result<void> append(const FrameStatistics& frame);
  /// Closes a run directory. `reason`: why the state is not "finished".
  Result<void> finish(const RunCounts& counts, const std::string& state, const std::string& reason);

 private:
  RunWriter writer_;
  std::vector<std::string> scheme_names_;
  std::string text_;
};

class FramesRun {
 public:
  /// Both must outlive the run.
  FramesRun(ImageFrames& images, const FramesOptions& options);
  /// Opens the files to write.
  Result<void> open(const RunInfo& info);
  /// Processes every frame. Returns false if a signal ended the run early. Rows of the frames before are
  /// whole.
  Result<bool> process();
  /// Closes the run. `reason`: why the state is not "finished".
  Result<void> finish(const std::string& state, const std::string& reason) {
    return sink_.finish(record_.counts, state, reason);
  }
  /// Writes the memory trace of a closed run, if the options want one.
  Result<void> write_memory_trace();
  /// Sums and counts for the summary.
  const RunRecord& record() const { return record_; }
  /// The last mismatch that --verify found.
  const std::optional<Error>& mismatch() const { return mismatch_; }

 private:
  Result<bool> process_stream();
  Result<bool> process_batch();
  std::string log_folder() const { return options_.to_stdout() ? log_folder_.path() : options_.run.output; }
  /// `log_record`: of block_log_; empty without one.
  Result<void> take(const FrameStatistics& statistics, const std::string& log_record);

  ImageFrames& images_;
  const FramesOptions& options_;
  ProgressLine progress_;
  RowSink sink_;
  CdfFile cdf_;
  BlockLog block_log_;
  TemporaryFolder log_folder_;  ///< of block_log_, if the rows go to standard output
  RunRecord record_;
  std::optional<Error> mismatch_;
};

}  // namespace tilepress
