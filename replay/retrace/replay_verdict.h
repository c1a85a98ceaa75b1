// Replay verdict: whether a replay captured what was asked for, and if not, why.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "replay_attempt.h"
#include "tilepress/run_reader.h"
#include "tilepress/trace_replay.h"

namespace tilepress {

/// What is known after a retracer has ended.
struct ReplayEvidence {
  const TraceSummary& trace;
  const RunOptions& options;
  uint64_t frames_wanted;  ///< frames of the trace that the options take
  std::chrono::seconds timeout;
  const std::string& retracer;
  const AttemptOutcome& outcome;
  const RunRecord* run;  ///< null if the shim left no run
};

/// Returns the result without its `run`.
ReplayResult judge(const ReplayEvidence& evidence);

/// How the retracer ended, as the end of a sentence; empty if it ended well.
std::string end_text(const ReplayEvidence& evidence);

/// "1 frame", "2 frames"
inline std::string plural(uint64_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace tilepress
