// Trace summary: reads a whole trace once and tells what it holds.
#include "tilepress/trace_summary.h"

#include <algorithm>

#include "trace_container.h"
#include "trace_events.h"
#include "trace_fault.h"
#include "trace_survey.h"

namespace tilepress {
namespace {

constexpr const char* kNoTrace = "is not an apitrace trace";

std::optional<TraceSummary> summarize(TraceInput& input, std::string& error, const TraceLimits& limits) {
  TraceSummary summary;
  summary.file_bytes = input.size();
  const std::unique_ptr<TraceContainer> container = open_container(input, error);
  if (!container) return std::nullopt;
  summary.container = container->name();
  const uint64_t expanded =
      input.size() > UINT64_MAX / limits.max_expansion ? UINT64_MAX : input.size() * limits.max_expansion;
  TraceStream stream(*container, std::max(limits.free_stream_bytes, expanded));
  TraceSurvey survey;
  TraceEvents events(stream, [&survey](std::string_view name) {
    survey.see_function(name);
    return TraceSurvey::watches(name);
  });
  bool header_read = false;
  try {
    if (!events.read_header()) {
      // Without a signature, any file may decompress to something by chance.
      error = !container->has_signature() && events.version() > 100
                  ? kNoTrace
                  : "has trace format version " + std::to_string(events.version()) + "; versions up to " +
                        std::to_string(TraceEvents::kNewestVersion) + " can be read";
      return std::nullopt;
    }
    header_read = true;
    TraceCall call;
    try {
      while (events.next(call)) survey.see(call, events.function(call.function));
    } catch (const TraceFault& fault) {
      if (fault.state == TraceState::kCorrupt) throw;
      summary.state = fault.state;
      summary.reason = fault.reason;
    }
    for (const TraceCall& open : events.open_calls()) survey.see(open, events.function(open.function));
  } catch (const TraceFault& fault) {
    summary.state = fault.state;
    summary.reason = fault.reason;
  }
  summary.offset = summary.stream_bytes = stream.offset();
  if (!container->has_signature() && (!header_read || events.calls_entered() == 0) &&
      summary.state != TraceState::kComplete) {
    error = kNoTrace;
    return std::nullopt;
  }
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

std::optional<TraceSummary> summarize_trace(const std::string& path, std::string& error,
                                            const TraceLimits& limits) {
  TraceInput input(path, error);
  if (!input.is_open()) return std::nullopt;
  try {
    return summarize(input, error, limits);
  } catch (const TraceFault& fault) {  // the disk failed within the first bytes
    error = fault.reason;
    return std::nullopt;
  }
}

std::optional<TraceSummary> summarize_trace(std::span<const uint8_t> file, std::string& error,
                                            const TraceLimits& limits) {
  TraceInput input(file);
  return summarize(input, error, limits);
}

bool begins_as_trace(const std::string& path) {
  std::string error;
  TraceInput input(path, error);
  if (!input.is_open()) return false;
  try {
    const std::unique_ptr<TraceContainer> container = open_container(input, error);
    if (!container) return false;
    TraceStream stream(*container, TraceLimits().free_stream_bytes);
    TraceEvents events(stream, [](std::string_view) { return false; });
    TraceCall call;
    return events.read_header() && events.next(call);
  } catch (const TraceFault&) {
    return false;
  }
}

const char* name_of(TraceApi api) {
  switch (api) {
    case TraceApi::kEgl:
      return "EGL";
    case TraceApi::kGlx:
      return "GLX";
    case TraceApi::kWgl:
      return "WGL";
    case TraceApi::kCgl:
      return "CGL";
    case TraceApi::kDirect3d:
      return "Direct3D";
    case TraceApi::kUnknown:
      break;
  }
  return "unknown";
}

const char* name_of(TraceState state) {
  switch (state) {
    case TraceState::kTruncated:
      return "truncated";
    case TraceState::kCorrupt:
      return "corrupt";
    case TraceState::kComplete:
      break;
  }
  return "complete";
}

}  // namespace tilepress
