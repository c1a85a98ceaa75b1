// tilepress replay: recorded traces through a headless retracer under the shim.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>

#include "command_line.h"
#include "common_options.h"
#include "frames/dumped_frames.h"
#include "printable.h"
#include "progress_line.h"
#include "capture/replay_tables.h"
#include "capture/shim_path.h"
#include "streams/ending_signals.h"
#include "temporary_folder.h"
#include "tilepress/replay_batch.h"
#include "capture/trace_manifest.h"
#include "verb.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShimName = "libtilepress-preload.so";

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress replay -o out game.trace\n"
    "  tilepress replay -o out -j 2 --resume traces/*.trace\n"
    "  tilepress replay -o out --manifest traces.toml --verify\n"
    "  tilepress replay -s vdcp --frames 100-199 --display xvfb game.trace\n"
    "\n"
    "Each trace leaves its run in DIR/<trace name>/; replay.csv and categories.csv in DIR hold the rates by "
    "trace and\n"
    "their harmonic means. A manifest lists traces as [[trace]] tables with path, and if wanted name, "
    "sha256,\n"
    "category (UI, 2D, 3D) and frames. Exit status: 1 if any trace failed, 3 if nothing was captured at "
    "all.\n";

struct VerbOptions {
  ReplayOptions replay;
  std::vector<std::string> traces;
  std::string manifest, progress_text = "auto";
  ProgressMode progress = ProgressMode::kAuto;
  unsigned jobs = 1;
  bool verbose = false, quiet = false;
};

template <typename T>
CLI::Option* add_choice(CLI::App& app, const std::string& flags, T& value,
                        const std::map<std::string, T>& choices, const std::string& words,
                        const std::string& text) {
  return app
      .add_option_function<std::string>(
          flags,
          [&value, choices, flags, words](const std::string& word) {
            const auto found = choices.find(word);
            if (found == choices.end())
              throw CLI::ValidationError(flags + ": '" + word + "' is none of " + words);
            value = found->second;
          },
          text)
      ->type_name(words);
}

std::optional<int> parse_options(int argc, char** argv, VerbOptions& options) {
  CLI::App app("Replays apitrace traces without a display and captures every frame.");
  app.footer(kExamples);
  ReplayOptions& replay = options.replay;
  int64_t timeout_s = replay.timeout.count();
  add_run_options(app, replay.run);
  add_capture_options(app, replay.run);
  app.add_option("TRACE", options.traces, "Traces");
  app.add_option("--manifest", options.manifest, "Traces with checksum, category and frames")
      ->type_name("FILE");
  app.add_option("-j,--jobs", options.jobs, "Traces to replay at a time (default: 1)")
      ->type_name("N")
      ->check(CLI::Range(1u, 1024u));
  app.add_flag("--resume", replay.resume, "Keep the runs of a batch that are finished, replay the others");
  add_choice<RetracerChoice>(
      app, "--api", replay.retracer,
      {{"auto", RetracerChoice::kAuto}, {"egl", RetracerChoice::kEgl}, {"glx", RetracerChoice::kGlx}},
      "auto|egl|glx", "Retracer: eglretrace or glretrace (default: auto)");
  add_choice<ReplayDisplay>(app, "--display", replay.display,
                            {{"auto", ReplayDisplay::kAuto},
                             {"surfaceless", ReplayDisplay::kSurfaceless},
                             {"xvfb", ReplayDisplay::kXvfb},
                             {"x11", ReplayDisplay::kX11}},
                            "auto|surfaceless|xvfb|x11",
                            "Nowhere, on a private Xvfb, or on the X server of DISPLAY (default: auto)");
  app.add_option("--timeout", timeout_s,
                 "Seconds without a frame until a retracer counts as hung (default: 300; 0: never)")
      ->type_name("S")
      ->check(CLI::Range(int64_t{0}, int64_t{1} << 30));
  app.add_option("--progress", options.progress_text, "auto, never or json (default: auto)")
      ->type_name("MODE");
  app.add_flag("-v,--verbose", options.verbose, "Tell what is done and why");
  app.add_flag("-q,--quiet", options.quiet, "No table");
  if (auto status = parse_command_line(app, argc, argv)) return status;
  replay.timeout = std::chrono::seconds(timeout_s);
  const auto mode = parse_progress_mode(options.progress_text);
  if (!mode)
    return fail(kExitUsage, "--progress: '" + options.progress_text + "' is none of auto, never, json");
  options.progress = *mode;
  if (options.traces.empty() && options.manifest.empty())
    return fail(kExitUsage, "no trace given (see tilepress replay --help)");
  if (replay.run.output == "-") return fail(kExitUsage, "--output -: a replay needs a folder");
  if (replay.retracer == RetracerChoice::kGlx && replay.display == ReplayDisplay::kSurfaceless)
    return fail(kExitUsage, "--api glx needs an X server and does not go with --display surfaceless");
  return std::nullopt;
}

/// The traces of the command line and of the manifest; two may not want the same folder.
std::optional<int> gather_inputs(const VerbOptions& options, std::vector<ReplayInput>& inputs) {
  std::string error;
  for (const std::string& path : options.traces)
    inputs.push_back({path, replay_name(path), "", "", std::nullopt});
  if (!options.manifest.empty() && !read_manifest(options.manifest, inputs, error))
    return fail(kExitUsage, error);
  std::map<std::string, std::string> taken;
  for (const ReplayInput& input : inputs) {
    const auto [other, added] = taken.emplace(input.name, input.path);
    if (!added)
      return fail(kExitUsage, other->second + " and " + input.path +
                                  ": both would be written to the folder " + input.name +
                                  " (a manifest can give names)");
  }
  return std::nullopt;
}

/// What a signal left of the batch, as a sentence; empty if every replay had come to its end before.
std::string interruption_text(const ReplayBatch& batch) {
  std::string done, cut, waiting;
  const auto add = [](std::string& list, const std::string& text) {
    list += (list.empty() ? "" : ", ") + printable(text);
  };
  for (const auto& replay : batch.replays()) {
    const ReplayResult& result = replay->result();
    const std::string& path = replay->input().path;
    if (result.status == ReplayStatus::kWaiting)
      add(waiting, path);
    else if (result.status == ReplayStatus::kDone || result.status == ReplayStatus::kKept)
      add(done, path);
    else
      add(cut, path + " " + result.reason);
  }
  const bool interrupted =
      std::any_of(batch.replays().begin(), batch.replays().end(),
                  [](const auto& replay) { return replay->result().status == ReplayStatus::kInterrupted; });
  if (!interrupted && waiting.empty()) return {};
  std::string text;
  if (!done.empty()) text += "done: " + done;
  if (!cut.empty()) text += (text.empty() ? "" : "; ") + cut;
  if (!waiting.empty()) text += (text.empty() ? "" : "; ") + std::string("not replayed: ") + waiting;
  return text;
}

/// The dumped frames of every run as PNG. False, and a line for each that failed.
bool convert_all_dumped_frames(const ReplayBatch& batch) {
  bool good = true;
  for (const auto& replay : batch.replays()) {
    const std::string& path = replay->result().run.path;
    std::string error;
    if (path.empty() || convert_dumped_frames(path, error)) continue;
    fail(kExitFailed, error);
    good = false;
  }
  return good;
}

/// One line per failed trace, and what its retracer said last.
int tell_failures(const ReplayBatch& batch) {
  constexpr size_t kShownLines = 5;
  uint64_t captured = 0;
  bool failed = !convert_all_dumped_frames(batch), nothing = false;
  for (const auto& replay : batch.replays()) {
    const ReplayResult& result = replay->result();
    captured += result.frames_captured;
    if (result.status == ReplayStatus::kDone || result.status == ReplayStatus::kKept) continue;
    nothing |= result.status == ReplayStatus::kNothingCaptured;
    failed |= result.status != ReplayStatus::kNothingCaptured;
    fail(kExitFailed,
         printable(replay->input().path) + ": " +
             (result.status == ReplayStatus::kWaiting ? "not replayed" : printable(result.reason)));
    const auto& lines = result.retracer_lines;
    for (size_t i = lines.size() - std::min(lines.size(), kShownLines); i < lines.size(); ++i)
      std::fprintf(stderr, "  said: %s\n", printable(lines[i]).c_str());
  }
  if (nothing && !failed && captured == 0) return kExitNothingCaptured;
  return failed || nothing ? kExitFailed : kExitDone;
}

}  // namespace

int verb_replay(int argc, char** argv) {
  VerbOptions options;
  if (auto status = parse_options(argc, argv, options)) return *status;
  std::vector<ReplayInput> inputs;
  if (auto status = gather_inputs(options, inputs)) return *status;

  std::string looked, error;
  const auto shim = find_shim(kShimName, looked);
  if (!shim) return fail(kExitFailed, std::string(kShimName) + ": not found (looked at " + looked + ")");
  TemporaryFolder links;
  options.replay.shim = preloadable(*shim, links, error);
  if (options.replay.shim.empty()) return fail(kExitFailed, error);
  std::error_code code;
  fs::path output = fs::absolute(options.replay.run.output, code).lexically_normal();
  options.replay.run.output = output.has_filename() ? output.string() : output.parent_path().string();

  ProgressLine progress(options.progress, "replay");
  std::mutex telling;
  if (options.verbose) {
    options.replay.explain = [&](const std::string& line) {
      const std::lock_guard lock(telling);
      clear_progress();
      std::fprintf(stderr, "tilepress: %s\n", printable(line).c_str());
    };
  }
  ReplayBatch batch(inputs, options.replay);
  batch.run(options.jobs, noted_signal(), [&](const BatchProgress& at) {
    const std::lock_guard lock(telling);
    progress.show(at.frames_done, at.frames_wanted);
  });
  clear_progress();
  const int signal = noted_signal();
  const std::string interruption = signal != 0 ? interruption_text(batch) : "";
  int status = kExitDone;
  if (!interruption.empty()) {
    convert_all_dumped_frames(batch);
    status = fail(128 + signal, signal_text(signal) + ": " + interruption);
  } else {
    if (!options.quiet) std::fputs(replay_table(batch.replays()).c_str(), stderr);
    status = tell_failures(batch);
  }
  if (fs::exists(options.replay.run.output, code) &&
      !write_replay_csv(options.replay.run.output, batch.replays(), error))
    status = fail(kExitFailed, error);
  return status;
}

}  // namespace tilepress
