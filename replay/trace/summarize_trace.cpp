// Summarize trace: puts container, stream, events and survey together.
#include "tilepress/trace_summary.h"

#include <algorithm>

#include "trace_container.h"
#include "trace_events.h"
#include "trace_survey.h"

namespace tilepress {
namespace {

constexpr const char* kNoTrace = "is not an apitrace trace";

/// The longest event stream that a file of `file_bytes` may unpack to.
uint64_t stream_limit(uint64_t file_bytes, const TraceLimits& limits) {
  const uint64_t expanded =
      file_bytes > UINT64_MAX / limits.max_expansion ? UINT64_MAX : file_bytes * limits.max_expansion;
  return std::max(limits.free_stream_bytes, expanded);
}

void note_fault(const TraceFault& fault, TraceSummary& summary) {
  summary.state = fault.state;
  summary.reason = fault.reason;
}

/// Shows the calls of the trace to `survey`: those that returned, then those that did not, which a retracer
/// repeats too. Throws TraceFault at damage; a cut is noted in `summary`.
void survey_calls(TraceEvents& events, TraceSurvey& survey, TraceSummary& summary) {
  const auto see = [&](const TraceCall& call) { survey.see(call, events.function(call.function)); };
  try {
    for (TraceCall call; events.next(call);) see(call);
  } catch (const TraceFault& fault) {
    if (fault.state == TraceState::kCorrupt) throw;
    note_fault(fault, summary);
  }
  for (const TraceCall& call : events.open_calls()) see(call);
}

Error version_error(uint64_t version, bool has_signature) {
  // Without a signature, any file may decompress to something by chance.
  if (!has_signature && version > 100) return {ErrorKind::kUnsupported, kNoTrace};
  return {ErrorKind::kUnsupported, "has trace format version " + std::to_string(version) +
                                       "; versions up to " + std::to_string(TraceEvents::kNewestVersion) +
                                       " can be read"};
}

Result<TraceSummary> summarize(TraceInput& input, const TraceLimits& limits) {
  const auto opened = open_container(input);
  if (!opened) return opened.error();
  TraceContainer& container = **opened;
  TraceStream stream(container, stream_limit(input.size(), limits));
  TraceSurvey survey;
  TraceEvents events(stream, [&survey](std::string_view name) {
    survey.see_function(name);
    return TraceSurvey::watches(name);
  });
  TraceSummary summary;
  bool header_read = false;
  try {
    header_read = events.read_header();
    if (!header_read) return version_error(events.version(), container.has_signature());
    survey_calls(events, survey, summary);
  } catch (const TraceFault& fault) {
    note_fault(fault, summary);
  }
  const bool begun = header_read && events.calls_entered() > 0;
  if (!container.has_signature() && !begun && summary.state != TraceState::kComplete)
    return Error{ErrorKind::kUnsupported, kNoTrace};
  summary.file_bytes = input.size();
  summary.container = container.name();
  summary.offset = summary.stream_bytes = stream.offset();
  summary.version = events.version();
  summary.semantic_version = events.semantic_version();
  summary.properties = events.properties();
  for (const auto& [name, value] : summary.properties)
    if (name == "process.name") summary.program = value;
  summary.calls = events.calls_entered();
  summary.open_calls = events.open_calls().size();
  survey.report(summary);
  return summary;
}

}  // namespace

Result<TraceSummary> summarize_trace(const std::string& path, const TraceLimits& limits) {
  Result<TraceInput> input = TraceInput::open(path);
  if (!input) return input.error();
  try {
    return summarize(*input, limits);
  } catch (const TraceFault& fault) {  // the disk failed within the first bytes
    return Error{ErrorKind::kFile, fault.reason};
  }
}

Result<TraceSummary> summarize_trace(std::span<const uint8_t> file, const TraceLimits& limits) {
  TraceInput input(file);
  return summarize(input, limits);
}

bool begins_as_trace(const std::string& path) {
  Result<TraceInput> input = TraceInput::open(path);
  if (!input) return false;
  try {
    const auto container = open_container(*input);
    if (!container) return false;
    TraceStream stream(**container, TraceLimits().free_stream_bytes);
    TraceEvents events(stream, [](std::string_view) { return false; });
    TraceCall call;
    return events.read_header() && events.next(call);
  } catch (const TraceFault&) {
    return false;
  }
}

const char* name_of(TraceApi api) {
  static constexpr const char* kNames[] = {"unknown", "EGL", "GLX", "WGL", "CGL", "Direct3D"};
  return kNames[static_cast<size_t>(api)];
}

const char* name_of(TraceState state) {
  static constexpr const char* kNames[] = {"complete", "truncated", "corrupt"};
  return kNames[static_cast<size_t>(state)];
}

}  // namespace tilepress
