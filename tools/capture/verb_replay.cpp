// tilepress replay: recorded traces through a headless retracer under the shim.
#include <filesystem>
#include <map>

#include "capture/output_folder.h"
#include "capture/replaced_runs.h"
#include "capture/replay_choices.h"
#include "capture/replay_outcome.h"
#include "capture/replay_tables.h"
#include "capture/run_traces.h"
#include "capture/shim_launch.h"
#include "capture/trace_manifest.h"
#include "command_line.h"
#include "common_options.h"
#include "frames/image_folders.h"
#include "progress_line.h"
#include "report/category_rules.h"
#include "streams/ending_signals.h"
#include "tilepress/run_reader.h"
#include "verb.h"
#include "way_out.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress replay -o out game.trace\n"
    "  tilepress replay -o out -j 2 --resume traces/*.trace\n"
    "  tilepress replay -o out --manifest traces.toml --verify\n"
    "  tilepress replay -o out --manifest traces-llvmpipe.yml --trace-folder traces-db --category 'glmark2*=3D'\n"
    "  tilepress replay -s vdcp --memory-trace {name}.csv.zst traces/*.trace\n"
    "  tilepress replay -s vdcp --frames 100-199 --display xvfb game.trace\n"
    "\n"
    "The run of each trace goes to DIR/<trace name>/. replay.csv and categories.csv in DIR hold the rates\n"
    "of the traces and their harmonic means. A manifest has a [[trace]] table per trace: path, and\n"
    "optionally name, sha256, category (UI, 2D, 3D) and frames. Mesa's traces-*.yml have no categories: give\n"
    "them with --category. Checksums of images in them are not read.\n"
    "Exit status: 1 if a trace failed, 3 if nothing was captured at all.\n";

struct VerbOptions {
  ReplayOptions replay;
  std::vector<std::string> traces;
  std::string manifest, trace_folder;
  std::vector<std::string> categories;
  MemoryTraceOptions trace;
  ProgressMode progress = ProgressMode::kAuto;
  unsigned jobs = 1;
  bool force = false, verbose = false, quiet = false;
};

std::optional<int> parse_options(int argc, char** argv, VerbOptions& options) {
  CLI::App app("Replays apitrace traces without a display and captures every frame.");
  app.footer(kExamples);
  ReplayOptions& replay = options.replay;
  add_run_options(app, replay.run);
  add_capture_options(app, replay.run);
  app.add_option("TRACE", options.traces, "Traces");
  app.add_option("--manifest", options.manifest,
                 "File that lists traces: TOML with checksum, category and frames, or Mesa's traces-*.yml")
      ->type_name("FILE");
  app.add_option("--trace-folder", options.trace_folder,
                 "Folder of the traces that Mesa's manifest lists (default: that of the manifest)")
      ->type_name("DIR");
  add_category_option(app, options.categories);
  app.add_option("-j,--jobs", options.jobs, "Traces to replay at a time (default: 1)")
      ->type_name("N")
      ->check(CLI::Range(1u, 1024u));
  app.add_flag("--resume", replay.resume, "Keep the finished runs of a batch and replay the other traces");
  app.add_flag("--force", options.force, "Replace the runs of earlier replays")->excludes("--resume");
  add_replay_choices(app, replay.retracer, replay.display, replay.timeout);
  add_memory_trace_options(app, options.trace, kRunTraceHelp);
  add_trace_refresh_option(app, options.trace);
  add_progress_option(app, options.progress);
  app.add_flag("-v,--verbose", options.verbose, "Explain each step");
  app.add_flag("-q,--quiet", options.quiet, "No table");
  if (auto status = parse_command_line(app, argc, argv)) return status;
  if (options.traces.empty() && options.manifest.empty())
    return fail(kExitUsage, "no trace given (see tilepress replay --help)");
  if (replay.run.output == "-") return fail(kExitUsage, "--output -: a replay needs a folder");
  if (replay.retracer == RetracerChoice::kGlx && replay.display == ReplayDisplay::kSurfaceless)
    return fail(kExitUsage, "--api glx needs an X server and does not go with --display surfaceless");
  if (const auto asked = ask_for_trace(options.trace, replay.run); !asked) return fail_trace(asked.error());
  set_message_level(options.verbose ? "info" : replay.run.log_level);
  return std::nullopt;
}

/// Replaces each folder by the *.trace files in it. A folder without one stays, and is refused as a trace.
std::vector<std::string> expand_trace_folders(const std::vector<std::string>& paths) {
  std::vector<std::string> out;
  for (const std::string& path : paths) {
    std::error_code code;
    std::vector<std::string> traces;
    if (std::filesystem::is_directory(path, code))
      if (const auto found =
              files_in_order(path, [](const std::string& file) { return file.ends_with(".trace"); }))
        traces = *found;
    if (traces.empty()) traces = {path};
    out.insert(out.end(), traces.begin(), traces.end());
  }
  return out;
}

/// Adds the traces of the manifest to those of the command line. Each needs a folder of its own.
Result<std::vector<ReplayInput>> gather_inputs(const VerbOptions& options) {
  std::vector<ReplayInput> inputs;
  for (const std::string& path : expand_trace_folders(options.traces))
    inputs.push_back({path, replay_name(path), "", "", std::nullopt});
  if (!options.manifest.empty()) {
    const auto listed = read_manifest(options.manifest, options.trace_folder);
    if (!listed) return listed.error();
    inputs.insert(inputs.end(), listed->begin(), listed->end());
  }
  std::vector<std::string> names;
  for (const ReplayInput& input : inputs) names.push_back(input.name);
  if (const auto checked = check_category_rules(options.categories, names); !checked) return checked.error();
  for (ReplayInput& input : inputs) input.category = category_by_rules(options.categories, input.name, input.category);
  std::map<std::string, std::string> taken;
  for (const ReplayInput& input : inputs) {
    const auto [other, added] = taken.emplace(input.name, input.path);
    if (!added)
      return Error{ErrorKind::kBadValue, other->second + " and " + input.path +
                                             ": both would be written to the folder " + input.name +
                                             " (a manifest can give names)"};
  }
  return inputs;
}

/// The runs of the replays that captured something.
std::vector<LoggedRun> captured_runs(const ReplayBatch& batch) {
  std::vector<LoggedRun> runs;
  for (const auto& replay : batch.replays())
    if (const std::string& path = replay->result().run.path; !path.empty())
      runs.push_back({replay->input().name, path});
  return runs;
}

/// Without the rows of refused replays: the finished run in their place has its own already.
std::vector<RateRow> rows_to_write(const ReplayBatch& batch, const std::string& output) {
  std::vector<RateRow> rows = rate_rows(batch.replays());
  std::erase_if(rows, [&](const RateRow& row) {
    return row.frames_captured == 0 && holds_run(output + "/" + row.trace);
  });
  return rows;
}

std::vector<std::string> missing_traces(const std::vector<ReplayInput>& inputs) {
  std::vector<std::string> paths;
  for (const ReplayInput& input : inputs) paths.push_back(input.path);
  return missing_paths(paths);
}

}  // namespace

int verb_replay(int argc, char** argv) {
  VerbOptions options;
  if (auto status = parse_options(argc, argv, options)) return *status;
  const auto inputs = gather_inputs(options);
  if (!inputs) return fail(kExitUsage, inputs.error());
  if (const auto fits = check_trace_path(options.trace, inputs->size()); !fits)
    return fail(kExitUsage, fits.error());

  const std::vector<std::string> missing = missing_traces(*inputs);
  for (const std::string& path : missing) fail(kExitFailed, missing_text(path));
  if (missing.size() == inputs->size()) return kExitFailed;

  TemporaryFolder links;
  const auto shim = preloadable_shim(false, links);
  if (!shim) return fail(kExitFailed, shim.error());
  options.replay.shim = *shim;
  const std::string given_output = options.replay.run.output, output = absolute_folder(given_output);
  options.replay.run.output = output;

  ReplacedRuns replaced;
  for (const ReplayInput& input : *inputs)
    if (options.force)
      if (const auto moved = replaced.set_aside(output + "/" + input.name); !moved)
        return fail(kExitFailed, moved.error());
  ReplayBatch batch(*inputs, options.replay);
  {
    ProgressLine progress(options.progress, "replay");
    batch.run(options.jobs, noted_signal(),
              [&progress](const BatchProgress& at) { progress.show(at.frames_done, at.frames_wanted); });
  }
  const int signal = noted_signal();
  const std::string interruption = signal != 0 ? interruption_text(batch) : "";
  int status = kExitDone;
  if (!interruption.empty()) {
    convert_all_dumped_frames(batch);
    status = fail(128 + signal, signal_text(signal) + ": " + interruption);
  } else {
    if (!options.quiet) show(rate_table(rate_rows(batch.replays()), "trace"));
    status = report_failures(batch, missing);
    if (!write_run_traces(captured_runs(batch), options.trace, false, options.quiet) && status == kExitDone)
      status = kExitFailed;
  }
  replaced.end();
  std::error_code code;
  if (!std::filesystem::exists(output, code)) return status;
  if (const auto written = write_replay_csv(output, rows_to_write(batch, output)); !written)
    return fail(kExitFailed, written.error());
  if (!options.quiet && interruption.empty() && !captured_runs(batch).empty()) show(next_command(given_output));
  return status;
}

}  // namespace tilepress
