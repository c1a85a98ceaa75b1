// Replay verdict: compares the frames captured with the frames of the trace.
#include "replay_verdict.h"

#include <algorithm>
#include <cstring>

namespace tilepress {
namespace {

/// Frames that the run should have. A trigger makes frames that the trace does not count. A window that
/// changes its shape becomes a new surface, whose frames are numbered from 0 again: then more or fewer frames
/// match the numbers asked for than the trace suggests, but the run accounts for every frame presented.
uint64_t expected_frames(const ReplayEvidence& evidence, const RunRecord& run) {
  const uint64_t captured = run.presented_frames(), in_trace = evidence.trace.frames;
  if (evidence.outcome.interrupted) return evidence.frames_wanted;
  if (evidence.options.triggers != 0) return captured;
  const bool all_accounted = evidence.frames_wanted != in_trace && run.counts.seen == in_trace &&
                             captured + run.counts.skipped == in_trace && captured > 0;
  return all_accounted ? captured : evidence.frames_wanted;
}

uint64_t mismatched_blocks(const RunRecord& run) {
  uint64_t sum = 0;
  for (const FrameStatistics& frame : run.frames)
    for (const SchemeStatistics& scheme : frame.schemes) sum += scheme.mismatched_blocks;
  return sum;
}

/// What happened to the missing frames, as far as the shim knows.
std::string missing_text(const ReplayEvidence& evidence, const RunCounts& counts) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (counts.unsupported > 0) add(std::to_string(counts.unsupported) + " in an unsupported format");
  if (counts.not_captured > 0) add(std::to_string(counts.not_captured) + " could not be read back");
  if (counts.dropped > 0) add(std::to_string(counts.dropped) + " dropped (queue full)");
  if (const std::string end = end_text(evidence); !end.empty()) add(end);
  if (!text.empty()) return text;
  if (evidence.run != nullptr) return evidence.retracer + " presented " + plural(counts.seen, "frame");
  return evidence.retracer +
         (evidence.outcome.seen.empty() ? " asked for no presenting function" : " presented nothing");
}

/// Debian's eglretrace says this where it finds no library under the names that only the -dev packages have.
bool lacks_gl_libraries(const AttemptOutcome& outcome) {
  return std::any_of(outcome.last_lines.begin(), outcome.last_lines.end(), [](const std::string& line) {
    return line.find("unavailable function eglGetProcAddress") != std::string::npos;
  });
}

}  // namespace

std::string end_text(const ReplayEvidence& evidence) {
  const AttemptOutcome& outcome = evidence.outcome;
  if (outcome.interrupted) return "interrupted";
  if (outcome.hung)
    return evidence.retracer + " showed no frame for " + std::to_string(evidence.timeout.count()) +
           " s and was ended";
  if (outcome.stopped_early) return "";
  if (outcome.signal)
    return evidence.retracer + " was ended by signal " + std::to_string(*outcome.signal) + " (" +
           strsignal(*outcome.signal) + ")";
  if (outcome.exit_status.value_or(0) != 0)
    return evidence.retracer + " ended with status " + std::to_string(*outcome.exit_status) +
           (lacks_gl_libraries(outcome)
                ? " (it loads libEGL.so and libGLESv2.so: Debian packages libegl-dev and libgles-dev)"
                : "");
  return "";
}

ReplayResult judge(const ReplayEvidence& evidence) {
  const AttemptOutcome& outcome = evidence.outcome;
  const TraceSummary& trace = evidence.trace;
  static const RunRecord kNoRun;
  const RunRecord& run = evidence.run != nullptr ? *evidence.run : kNoRun;
  const uint64_t captured = run.presented_frames();
  ReplayResult result;
  result.frames_in_trace = trace.frames;
  result.frames_wanted = expected_frames(evidence, run);
  result.frames_captured = captured;
  result.frames_unsupported = run.counts.unsupported;
  result.seconds = outcome.seconds;
  const auto end_with = [&result](ReplayStatus status, std::string reason) {
    result.status = status;
    result.reason = std::move(reason);
    return result;
  };
  const std::string of_wanted = " of " + plural(result.frames_wanted, "frame");
  const bool complete = captured == result.frames_wanted && captured > 0;
  if (outcome.interrupted && !(complete && evidence.options.triggers == 0))
    return end_with(ReplayStatus::kInterrupted, "stopped after " + std::to_string(captured) + of_wanted);
  if (complete) {
    if (const uint64_t mismatched = mismatched_blocks(run); mismatched > 0)
      return end_with(ReplayStatus::kFailed,
                      "--verify: " + plural(mismatched, "block") + " decoded to other pixels");
    if (trace.state == TraceState::kTruncated)
      return end_with(ReplayStatus::kFailed, "truncated after " + plural(trace.frames, "frame") + ": " +
                                                 trace.reason + "; the frames before were captured");
    return end_with(ReplayStatus::kDone, "");
  }
  result.retracer_lines = outcome.last_lines;
  const std::string captured_text = "captured " + std::to_string(captured) + of_wanted + ": ";
  if (run.state == "failed" && !run.reason.empty())
    return end_with(ReplayStatus::kFailed, captured_text + run.reason);
  if (captured == 0)
    return end_with(ReplayStatus::kNothingCaptured,
                    "no frame captured" + of_wanted + ": " + missing_text(evidence, run.counts));
  return end_with(ReplayStatus::kFailed, captured_text + missing_text(evidence, run.counts));
}

}  // namespace tilepress
