// Row sink: where the rows of `tilepress frames` go, a run directory or standard output.
#pragma once

#include <string>
#include <vector>

#include "tilepress/result.h"
#include "tilepress/run_directory.h"

namespace tilepress {

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

}  // namespace tilepress
