// Run traces: the memory traces of captured runs.
#pragma once

#include <string>
#include <vector>

#include "memory_trace/trace_options.h"
#include "tilepress/result.h"

namespace tilepress {

/// A captured run whose blocks were logged.
struct LoggedRun {
  std::string name;    ///< in place of "{name}" in the path of the trace
  std::string folder;
};

/// Fails if several runs would be written to one file. Error: kBadValue.
Result<void> check_trace_path(const MemoryTraceOptions& options, size_t runs);

/// Writes the trace of each run and a line about it. `has_times`: the runs' times are those of a program. The
/// logs stay in the folders. Writes each error, and returns false if there was one.
bool write_run_traces(const std::vector<LoggedRun>& runs, const MemoryTraceOptions& options, bool has_times,
                      bool quiet);

}  // namespace tilepress
