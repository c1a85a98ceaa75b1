// tilepress record: a program under apitrace, the API chosen and the recording checked.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "capture/child_process.h"
#include "capture/tracer_output.h"
#include "command_line.h"
#include "counted.h"
#include "printable.h"
#include "tilepress/program_api.h"
#include "tilepress/program_search.h"
#include "tilepress/trace_summary.h"
#include "verb.h"
#include "way_out.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples =
    "Examples:\n"
    "  xvfb-run -a tilepress record -o desktop.trace -- glmark2-es2 -b desktop:duration=3\n"
    "  tilepress record --api glx -o gears.trace -- glxgears\n"
    "  xvfb-run -a tilepress record -o game.trace -- ./game --level 3\n"
    "\n"
    "The names in the program's file decide between EGL and GLX. If the recording holds no frame, the\n"
    "program runs again, recorded through the other API.\n"
    "Exit status: 0 frames recorded, 1 failed, 3 no frame.\n";

enum class RecordApi : uint8_t { kAuto, kEgl, kGlx };

struct RecordOptions {
  std::string output;
  RecordApi api = RecordApi::kAuto;
  bool verbose = false;
  std::vector<std::string> program;
};

std::optional<int> parse_options(int argc, char** argv, RecordOptions& options) {
  CLI::App app("Records the EGL or GLX calls of PROGRAM into an apitrace trace.");
  app.footer(kExamples);
  app.add_option("-o,--output", options.output, "The trace to write")->type_name("FILE")->required();
  add_choice_option<RecordApi>(
      app, "--api", options.api,
      {{"auto", RecordApi::kAuto}, {"egl", RecordApi::kEgl}, {"glx", RecordApi::kGlx}},
      "Which calls to record (default: auto)");
  app.add_flag("-v,--verbose", options.verbose, "Explain each step, and show what apitrace prints");
  if (auto status = parse_launch_line(app, argc, argv, options.program)) return status;
  if (options.verbose) set_message_level("info");
  return std::nullopt;
}

struct Recording {
  int program_status = 0;
  Result<TraceSummary> trace;  ///< of a recording with frames; or why the recording cannot be used
  std::vector<std::string> said = {};  ///< apitrace's lines, unless they are shown at once
};

Result<TraceSummary> look_at(const std::string& file, TraceApi api) {
  const auto useless = [](std::string reason) { return Error{ErrorKind::kUnsupported, std::move(reason)}; };
  std::error_code code;
  if (!fs::exists(file, code) || fs::file_size(file, code) == 0)
    return useless(
        fmt::format("apitrace wrote nothing: the program made no {} call, or ended before it", name_of(api)));
  auto trace = summarize_trace(file);
  if (!trace || trace->frames > 0) return trace;
  if (trace->calls == 0)
    return useless(fmt::format("the program made no {} or GL call that could be recorded", name_of(api)));
  return useless(counted(trace->calls, "call") + " recorded, none of them presents a frame");
}

Recording record_once(const RecordOptions& options, TraceApi api, const std::string& file) {
  std::vector<std::string> command = {"apitrace", "trace", api == TraceApi::kEgl ? "--api=egl" : "--api=gl",
                                      "--output=" + file};
  command.insert(command.end(), options.program.begin(), options.program.end());
  TracerOutput output;
  if (!options.verbose) output.begin();
  const auto child = run_child(command, {});
  output.end();
  if (!child) return {start_status(child.error()), child.error()};
  return {child->status(), look_at(file, api), output.lines()};
}

bool is_fault(const std::string& line) {
  return line.starts_with("apitrace: warning: ") || line.starts_with("apitrace: error: ");
}

/// Gives a good recording its name and says what it holds.
int keep(const RecordOptions& options, const Recording& recording, const std::string& file) {
  std::error_code code;
  fs::rename(file, options.output, code);
  if (code) return fail(kExitFailed, options.output + ": " + code.message());
  const TraceSummary& trace = *recording.trace;
  const TraceSurface& surface = trace.surfaces.front();
  std::string text = fmt::format("{}: {}, {}x{}, {}, {}\n", options.output, counted(trace.frames, "frame"),
                                 surface.width, surface.height, name_of(trace.api),
                                 trace.contexts.empty() ? "context unknown" : printable(trace.contexts));
  if (trace.state != TraceState::kComplete)
    text += "  the last calls are cut off, the frames before are good: " + trace.reason + "\n";
  if (recording.program_status != 0)
    text += fmt::format("  the program ended with status {}\n", recording.program_status);
  if (const auto faults = std::ranges::count_if(recording.said, is_fault); faults > 0)
    text += "  apitrace reports " + counted(static_cast<uint64_t>(faults), "problem") +
            "; -v shows what it prints\n";
  show(text);
  return kExitDone;
}

/// The APIs to try, the likelier first.
std::vector<TraceApi> apis_to_try(RecordApi asked, const std::string& program) {
  if (asked == RecordApi::kEgl) return {TraceApi::kEgl};
  if (asked == RecordApi::kGlx) return {TraceApi::kGlx};
  const ApiGuess guess = guess_program_api(program);
  say(MessageLevel::kInfo, fmt::format("recording {} ({})", name_of(guess.api), guess.why));
  return {guess.api, guess.api == TraceApi::kEgl ? TraceApi::kGlx : TraceApi::kEgl};
}

}  // namespace

int verb_record(int argc, char** argv) {
  RecordOptions options;
  if (auto status = parse_options(argc, argv, options)) return *status;
  std::error_code code;
  if (fs::exists(options.output, code))
    return fail(kExitFailed, options.output + ": exists already (remove it, or give another name)");
  if (const auto checked = check_folder_of(options.output); !checked)
    return fail(kExitFailed, checked.error());
  if (const auto apitrace = find_program("apitrace"); !apitrace)
    return fail(kExitFailed, apitrace.error().text + " (Debian packages apitrace and apitrace-tracers)");
  const auto program = find_program(options.program.front());
  if (!program) return fail(kExitFailed, program.error());

  const std::vector<TraceApi> apis = apis_to_try(options.api, *program);
  const std::string& name = options.program.front();
  const std::string file = options.output + ".partial";
  for (size_t i = 0;; ++i) {
    fs::remove(file, code);
    const Recording recording = record_once(options, apis[i], file);
    if (recording.trace) return keep(options, recording, file);
    std::string reason = recording.trace.error().text;
    // A program that was ended by a signal or never started would fail the second time too.
    if (recording.program_status < kExitNotExecutable && i + 1 < apis.size()) {
      say(MessageLevel::kWarning, fmt::format("{}: nothing through {} ({}); running it again for {}", name,
                                              name_of(apis[i]), reason, name_of(apis[i + 1])));
      continue;
    }
    fs::remove(file, code);
    if (recording.program_status != 0)
      reason += fmt::format(" (it ended with status {})", recording.program_status);
    const int status = fail(kExitNothingCaptured, name + ": no frame recorded: " + reason);
    show(last_words(recording.said) + display_hint("record"));
    return status;
  }
}

}  // namespace tilepress
