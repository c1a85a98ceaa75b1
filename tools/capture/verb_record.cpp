// tilepress record: a program under apitrace, the API chosen and the recording checked.
#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <filesystem>

#include "capture/child_process.h"
#include "command_line.h"
#include "printable.h"
#include "tilepress/program_api.h"
#include "tilepress/trace_summary.h"
#include "verb.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress record -o desktop.trace -- glmark2-es2 -b desktop:duration=3 --run-forever\n"
    "  tilepress record --api glx -o gears.trace -- glxgears\n"
    "\n"
    "The API is taken from the names in the program's file. If they do not tell, or if the recording holds "
    "no frame,\n"
    "the program is run again under the other one. Exit status: 0 frames were recorded, 1 failed, 3 no "
    "frame.\n";

struct RecordOptions {
  std::string output, api = "auto";
  bool verbose = false;
  std::vector<std::string> program;
};

std::optional<int> parse_options(int argc, char** argv, RecordOptions& options) {
  CLI::App app("Records the EGL or GLX calls of PROGRAM into an apitrace trace.");
  app.get_formatter()->label("OPTIONS", "OPTIONS] -- PROGRAM [ARGS...");  // CLI11 puts it in brackets
  app.footer(kExamples);
  app.prefix_command();
  app.add_option("-o,--output", options.output, "The trace to write")->type_name("FILE")->required();
  app.add_option("--api", options.api, "auto, egl or glx (default: auto)")
      ->type_name("auto|egl|glx")
      ->check([](const std::string& word) {
        return word == "auto" || word == "egl" || word == "glx" ? std::string()
                                                                : "'" + word + "' is none of auto, egl, glx";
      });
  app.add_flag("-v,--verbose", options.verbose, "Tell what is done and why");

  // All behind the first "--" is the program's, whatever it looks like.
  int own = 1;
  while (own < argc && std::strcmp(argv[own], "--") != 0) ++own;
  if (auto status = parse_command_line(app, own, argv)) return status;
  options.program = app.remaining();
  for (int i = own + 1; i < argc; ++i) options.program.emplace_back(argv[i]);
  if (options.program.empty()) return fail(kExitUsage, "no program given (see tilepress record --help)");
  if (own == argc && options.program.front().starts_with("-"))
    return fail(kExitUsage, "unknown option '" + options.program.front() + "'");
  if (own < argc && !app.remaining().empty())
    return fail(kExitUsage, "unexpected argument '" + app.remaining().front() + "'");
  return std::nullopt;
}

/// What one recording came to.
struct Recording {
  int program_status = 0;
  std::optional<TraceSummary> trace;
  std::string fault;  ///< why it is of no use; empty if it has frames
};

Recording record_once(const RecordOptions& options, TraceApi api, const std::string& file) {
  Recording recording;
  std::vector<std::string> command = {"apitrace", "trace", api == TraceApi::kEgl ? "--api=egl" : "--api=gl",
                                      "--output=" + file};
  command.insert(command.end(), options.program.begin(), options.program.end());
  StartFailure failure{};
  const auto child = run_child(command, {}, failure);
  if (!child) {
    recording.program_status = failure.status;
    recording.fault = failure.reason;
    return recording;
  }
  recording.program_status = child->status();
  std::error_code code;
  if (!fs::exists(file, code) || fs::file_size(file, code) == 0) {
    recording.fault =
        fmt::format("apitrace wrote nothing: the program made no {} call, or left before", name_of(api));
    return recording;
  }
  recording.trace = summarize_trace(file, recording.fault);
  if (!recording.trace) return recording;
  const TraceSummary& trace = *recording.trace;
  if (trace.frames == 0)
    recording.fault =
        trace.calls == 0
            ? fmt::format("the program made no {} or GL call that could be recorded", name_of(api))
            : fmt::format("{} calls recorded, none of them presents a frame", trace.calls);
  return recording;
}

void tell(const RecordOptions& options, const std::string& line) {
  if (options.verbose) std::fprintf(stderr, "tilepress: %s\n", printable(line).c_str());
}

/// The recording is good: gives it its name and says what it holds.
int keep(const RecordOptions& options, const Recording& recording, const std::string& file) {
  std::error_code code;
  fs::rename(file, options.output, code);
  if (code) return fail(kExitFailed, options.output + ": " + code.message());
  const TraceSummary& trace = *recording.trace;
  const TraceSurface& surface = trace.surfaces.front();
  std::fprintf(stderr, "%s: %llu frames, %ux%u, %s, %s\n", options.output.c_str(),
               static_cast<unsigned long long>(trace.frames), surface.width, surface.height,
               name_of(trace.api),
               printable(trace.contexts.empty() ? "context unknown" : trace.contexts).c_str());
  if (trace.state != TraceState::kComplete)
    std::fprintf(stderr, "  the last calls are cut off, the frames before are good: %s\n",
                 trace.reason.c_str());
  if (recording.program_status != 0)
    std::fprintf(stderr, "  the program ended with status %d\n", recording.program_status);
  return kExitDone;
}

}  // namespace

int verb_record(int argc, char** argv) {
  RecordOptions options;
  if (auto status = parse_options(argc, argv, options)) return *status;
  std::error_code code;
  if (fs::exists(options.output, code)) return fail(kExitFailed, options.output + ": exists already");
  StartFailure failure{};
  if (!find_program("apitrace", failure))
    return fail(kExitFailed, failure.reason + " (Debian packages apitrace and apitrace-tracers)");
  const auto program = find_program(options.program.front(), failure);
  if (!program) return fail(kExitFailed, failure.reason);

  std::vector<TraceApi> apis = {options.api == "egl" ? TraceApi::kEgl : TraceApi::kGlx};
  if (options.api == "auto") {
    const ApiGuess guess = guess_program_api(*program);
    tell(options, fmt::format("recording {} ({})", name_of(guess.api), guess.why));
    apis = {guess.api, guess.api == TraceApi::kEgl ? TraceApi::kGlx : TraceApi::kEgl};
  }
  const std::string file = options.output + ".partial";
  Recording recording;
  for (size_t i = 0; i < apis.size(); ++i) {
    fs::remove(file, code);
    recording = record_once(options, apis[i], file);
    if (recording.fault.empty()) return keep(options, recording, file);
    // A program that was ended by a signal or never started would not do better the second time.
    if (recording.program_status >= kExitNotExecutable || i + 1 == apis.size()) break;
    std::fprintf(stderr, "tilepress: %s: nothing through %s (%s); running it again for %s\n",
                 options.program.front().c_str(), name_of(apis[i]), recording.fault.c_str(),
                 name_of(apis[i + 1]));
  }
  fs::remove(file, code);
  std::string reason = recording.fault;
  if (recording.program_status != 0)
    reason += fmt::format(" (it ended with status {})", recording.program_status);
  return fail(kExitNothingCaptured, options.program.front() + ": no frame recorded: " + reason);
}

}  // namespace tilepress
