// Run traces: one file per run.
#include "capture/run_traces.h"

#include "exit_status.h"
#include "memory_trace/frame_trace.h"
#include "streams/messages.h"
#include "tilepress/block_log.h"

namespace tilepress {
namespace {

Result<std::string> write_run_trace(const LoggedRun& run, const MemoryTraceOptions& options, bool has_times,
                                    ProgressMode progress) {
  const auto frames = open_logged_frames(run.folder + "/" + std::string(kBlockLogName), has_times);
  if (!frames) return frames.error();
  return write_frame_trace(options.path_of(run.name), options, **frames, progress);
}

}  // namespace

Result<void> check_trace_path(const MemoryTraceOptions& options, size_t runs) {
  if (options.path.empty() || runs < 2 || options.has_name_part()) return {};
  return Error{ErrorKind::kBadValue, "--memory-trace " + options.path + ": " + std::to_string(runs) +
                                         " runs need a file each; put {name} into the path"};
}

bool write_run_traces(const std::vector<LoggedRun>& runs, const MemoryTraceOptions& options, bool has_times,
                      bool quiet) {
  if (options.path.empty()) return true;
  if (const auto fits = check_trace_path(options, runs.size()); !fits) {
    fail(kExitFailed, fits.error());
    for (const LoggedRun& run : runs)
      show("  to write it now: tilepress memory-trace " + run.folder + " -o FILE\n");
    return false;
  }
  bool good = true;
  for (const LoggedRun& run : runs) {
    const auto written =
        write_run_trace(run, options, has_times, quiet ? ProgressMode::kNever : ProgressMode::kAuto);
    if (!written) {
      fail(kExitFailed, written.error());
      good = false;
    } else if (!quiet) {
      show("  " + *written);
    }
  }
  return good;
}

}  // namespace tilepress
