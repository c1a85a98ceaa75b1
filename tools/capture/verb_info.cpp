// tilepress info: prints what a trace holds, for people or as JSON.
#include <fmt/core.h>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command_line.h"
#include "counted.h"
#include "input_kind.h"
#include "printable.h"
#include "tilepress/trace_summary.h"
#include "verb.h"
#include "way_out.h"

namespace tilepress {
namespace {

using Json = nlohmann::ordered_json;

Json trace_json(const std::string& path, const TraceSummary& trace) {
  Json surfaces = Json::array();
  for (const TraceSurface& surface : trace.surfaces)
    surfaces.push_back({{"id", fmt::format("{:#x}", surface.id)},
                        {"frames", surface.frames},
                        {"width", surface.width},
                        {"height", surface.height}});
  Json properties = Json::object();
  for (const auto& [name, value] : trace.properties) properties[name] = value;
  return {{"path", path},
          {"state", name_of(trace.state)},
          {"reason", trace.reason},
          {"offset", trace.offset},
          {"program", trace.program},
          {"api", name_of(trace.api)},
          {"contexts", trace.contexts},
          {"version", trace.version},
          {"semantic_version", trace.semantic_version},
          {"container", trace.container},
          {"file_bytes", trace.file_bytes},
          {"stream_bytes", trace.stream_bytes},
          {"gl_version", trace.gl_version},
          {"gl_renderer", trace.gl_renderer},
          {"frames", trace.frames},
          {"surfaces", surfaces},
          {"calls", trace.calls},
          {"open_calls", trace.open_calls},
          {"threads", trace.threads},
          {"duration_s",
           trace.duration_ns ? Json(static_cast<double>(*trace.duration_ns) * 1e-9) : Json(nullptr)},
          {"properties", properties}};
}

void print_line(const char* label, const std::string& text) {
  std::printf("  %-10s %s\n", label, printable(text).c_str());
}

void print_trace(const std::string& path, const TraceSummary& trace) {
  std::printf("%s\n", printable(path).c_str());
  print_line("program", trace.program.empty() ? "not recorded" : trace.program);
  print_line("api", std::string(name_of(trace.api)) + (trace.contexts.empty() ? "" : ", " + trace.contexts));
  if (!trace.gl_version.empty()) print_line("recorded", trace.gl_renderer + ", " + trace.gl_version);
  print_line("format",
             fmt::format("version {} (semantics {}), {}, {} bytes, {} unpacked", trace.version,
                         trace.semantic_version, trace.container, trace.file_bytes, trace.stream_bytes));
  print_line("frames", std::to_string(trace.frames));
  const char* label = "surfaces";
  for (const TraceSurface& surface : trace.surfaces) {
    const std::string size =
        surface.width == 0 ? "size not recorded" : fmt::format("{}x{}", surface.width, surface.height);
    print_line(label, fmt::format("{:#x}: {}, {}", surface.id, size, counted(surface.frames, "frame")));
    label = "";
  }
  std::string calls = fmt::format("{} by {}", trace.calls, counted(trace.threads, "thread"));
  if (trace.open_calls > 0) calls += fmt::format(", {} never returned", trace.open_calls);
  print_line("calls", calls);
  print_line("duration", trace.duration_ns ? fmt::format("{:.3f} s between the program's GPU time stamps",
                                                         static_cast<double>(*trace.duration_ns) * 1e-9)
                                           : "not recorded");
  if (trace.state != TraceState::kComplete)
    print_line("state", fmt::format("{} at byte {} of the stream: {}", name_of(trace.state), trace.offset,
                                    trace.reason));
}

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress info game.trace\n"
    "  tilepress info traces/*.trace\n"
    "  tilepress info --json game.trace > game.json\n";

}  // namespace

int verb_info(int argc, char** argv) {
  CLI::App app("Prints what apitrace traces hold, without replaying them.");
  app.footer(kExamples);
  bool json = false;
  std::vector<std::string> paths;
  app.add_flag("--json", json, "As JSON: an array with an object for each trace");
  app.add_option("TRACE", paths, "Traces")->required();
  if (auto status = parse_command_line(app, argc, argv)) return *status;

  int status = kExitDone;
  Json list = Json::array();
  for (const std::string& path : paths) {
    const auto trace = summarize_trace(path);
    if (!trace) {
      Error error = about(path, trace.error());
      error.text += missing_paths({path}).empty() ? verb_hint(path, "replay") : path_hint(path);
      status = fail(kExitFailed, error);
      if (json) list.push_back({{"path", path}, {"state", "unreadable"}, {"reason", trace.error().text}});
      continue;
    }
    json ? list.push_back(trace_json(path, *trace)) : print_trace(path, *trace);
    if (trace->state != TraceState::kComplete) {
      std::fflush(stdout);
      status = fail(kExitFailed, fmt::format("{}: {} after {}: {}", path, name_of(trace->state),
                                             counted(trace->frames, "frame"), trace->reason));
    }
  }
  if (json) std::printf("%s\n", list.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
  return status;
}

}  // namespace tilepress
