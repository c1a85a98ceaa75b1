// Replay attempt: a retracer on one road, from its start until it has ended or had to be ended.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "replay_road.h"
#include "tilepress/trace_replay.h"

namespace tilepress {

/// What an attempt needs to know.
struct AttemptOrder {
  std::string trace_path;          ///< absolute
  std::string folder;              ///< private to the attempt; the shim writes into folder/runs
  uint32_t width = 0, height = 0;  ///< largest surface of the trace
  uint64_t frames_wanted = 0;
  bool may_stop_early = false;  ///< frames behind the last wanted one need not be replayed
};

struct AttemptOutcome {
  std::string error;  ///< it could not be started; the rest is then empty
  std::optional<int> exit_status, signal;
  bool stopped_early = false;  ///< ended by us behind the last wanted frame
  bool hung = false;           ///< ended by us for want of progress
  bool interrupted = false;    ///< ended by us, on request
  double seconds = 0;
  std::vector<std::string> last_lines;  ///< of standard error
  std::vector<std::string> seen;        ///< entry points that the shim met
};

/// Runs to the end, or until `stop` says so. `rows` receives the number of finished frames all along.
AttemptOutcome run_attempt(const ReplayRoad& road, const AttemptOrder& order, const ReplayOptions& options,
                           const RunOptions& run, const std::function<bool()>& stop,
                           std::atomic<uint64_t>& rows);

}  // namespace tilepress
