// Replay attempt: one retracer on one road, from its start to its end.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "replay_road.h"
#include "tilepress/trace_replay.h"

namespace tilepress {

struct AttemptOrder {
  std::string trace_path;          ///< absolute
  std::string folder;              ///< private to the attempt; the shim writes into folder/runs
  uint32_t width = 0, height = 0;  ///< largest surface of the trace
  uint64_t frames_wanted = 0;
  bool may_stop_early = false;  ///< frames after the last wanted one need not be replayed
};

struct AttemptOutcome {
  std::optional<int> exit_status, signal;
  bool stopped_early = false;  ///< ended by us after the last wanted frame
  bool hung = false;           ///< ended by us because no frame came
  bool interrupted = false;    ///< ended by us, or not started, because `stop` returned true
  double seconds = 0;
  std::vector<std::string> last_lines;  ///< of standard error
  std::vector<std::string> seen;        ///< entry points that the shim met
};

/// Runs the retracer to its end, or until `stop` returns true. `rows` always holds the number of finished
/// frames. Logs the shim's messages. Error, one line: the retracer or its X server could not be started.
Result<AttemptOutcome> run_attempt(const ReplayRoad& road, const AttemptOrder& order,
                                   const ReplayOptions& options, const RunOptions& run,
                                   const std::function<bool()>& stop, std::atomic<uint64_t>& rows);

}  // namespace tilepress
