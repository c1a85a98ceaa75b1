// tilepress run: a program under the shim, its own input, output and exit status passed through.
#include <fmt/format.h>

#include <filesystem>

#include "capture/nothing_captured.h"
#include "capture/output_folder.h"
#include "capture/overhead_rounds.h"
#include "capture/program_launch.h"
#include "capture/run_traces.h"
#include "capture/shim_launch.h"
#include "command_line.h"
#include "common_options.h"
#include "counted.h"
#include "tilepress/program_search.h"
#include "verb.h"
#include "way_out.h"
#include "workload_options.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress run -o out -- glmark2-es2 -b desktop:duration=5\n"
    "  tilepress run -s vdcp -s vdcp:fvc=128,policy=2lfc -- glxgears\n"
    "  tilepress run -s vdcp --memory-trace game.gem5.gz -- ./game\n"
    "  tilepress run --frames 100-199 --verify -- ./game --level 3\n"
    "  xvfb-run -a tilepress run -q -- glmark2\n"
    "  tilepress run --measure-overhead --seconds 10 -- glxgears\n"
    "\n"
    "The rows of each process that presents frames go to DIR/<program>-<pid>/. Exit status: the program's\n"
    "own, or 128+n if signal n ended it; 125 tilepress failed, 126 not executable, 127 not found; 3 if the\n"
    "program ended well and no frame was captured; 1 if --verify found a difference.\n";

struct RunVerbOptions {
  LaunchOptions launch;
  MemoryTraceOptions trace;
  bool measure_overhead = false;
  unsigned rounds = 2;
};

std::optional<int> parse_options(int argc, char** argv, RunVerbOptions& options) {
  LaunchOptions& launch = options.launch;
  CLI::App app("Runs PROGRAM and captures every frame it presents through EGL or GLX.");
  app.footer(kExamples);
  add_run_options(app, launch.run);
  add_capture_options(app, launch.run);
  add_choice_option<ShimRoad>(
      app, "--via", launch.via,
      {{"auto", ShimRoad::kAuto}, {"preload", ShimRoad::kPreload}, {"glvnd", ShimRoad::kGlvnd}},
      "How the shim gets into the program (default: auto)");
  WorkloadLabel workload;
  add_workload_options(app, workload);
  app.add_flag("-q,--quiet", launch.quiet, "No summary");
  app.add_flag("--measure-overhead", options.measure_overhead,
               "Run the program with and without capture, compare frame times, write DIR/overhead.csv");
  add_memory_trace_options(app, options.trace, kRunTraceHelp);
  add_trace_refresh_option(app, options.trace);
  app.get_option("--memory-trace")->excludes("--measure-overhead");
  app.add_option("--rounds", options.rounds, "With --measure-overhead: runs of each kind (default: 2)")
      ->type_name("N")
      ->check(CLI::Range(1, 100));
  app.add_option("--seconds", launch.seconds,
                 "End the program with SIGTERM after S seconds (default: it ends by itself)")
      ->type_name("S")
      ->check(CLI::Range(0.1, 86400.0));
  if (auto status = parse_launch_line(app, argc, argv, launch.program)) return status;
  launch.labels = workload.members();
  if (launch.run.output == "-") return fail(kExitUsage, "--output -: standard output is the program's");
  if (const auto asked = ask_for_trace(options.trace, launch.run); !asked) return fail_trace(asked.error(), kExitLauncherFailed);
  set_message_level(launch.run.log_level);
  return std::nullopt;
}

/// The runs of the program's processes, named as their folders.
std::vector<LoggedRun> captured_runs(const std::vector<CapturedProcess>& processes) {
  std::vector<LoggedRun> runs;
  for (const CapturedProcess& process : processes)
    runs.push_back({std::filesystem::path(process.run_path).filename().string(), process.run_path});
  return runs;
}

}  // namespace

int verb_run(int argc, char** argv) {
  RunVerbOptions options;
  if (auto status = parse_options(argc, argv, options)) return *status;
  LaunchOptions& launch = options.launch;

  const auto program = find_program(launch.program.front());
  if (!program) return fail(start_status(program.error()), program.error());
  TemporaryFolder links;
  const auto shim = preloadable_shim(launch.run.all_targets, links);
  if (!shim) return fail(kExitLauncherFailed, shim.error());
  launch.shim = *shim;
  const std::string given_output = launch.run.output;
  launch.run.output = absolute_folder(launch.run.output);
  OutputFolder output;
  if (const auto made = output.prepare(launch.run.output); !made)
    return fail(kExitLauncherFailed, made.error());
  if (options.measure_overhead) return measure_overhead(launch, options.rounds, *program);

  SessionFolder session;
  const auto done = launch_program(launch, session);
  if (!done) return fail(start_status(done.error()), done.error());
  const Harvest& found = done->found;
  const bool traced = write_run_traces(captured_runs(done->processes), options.trace, true, launch.quiet);
  if (!launch.quiet && found.captured > 0) show(next_command(given_output));
  if (const int status = done->child.own_status(); status != 0) {
    if (!launch.quiet && found.captured == 0 && !done->child.signal)
      show(fmt::format("tilepress: {}: ended with status {}, no frame captured\n", launch.program.front(),
                       status) +
           display_hint("run"));
    return status;
  }
  if (found.failed || !traced) return kExitLauncherFailed;
  if (found.captured == 0) return report_nothing_captured(launch, session, found.seen, *program);
  if (found.mismatched_blocks > 0)
    return fail(kExitFailed,
                "--verify: " + counted(found.mismatched_blocks, "block") + " decoded to other pixels");
  return kExitDone;
}

}  // namespace tilepress
