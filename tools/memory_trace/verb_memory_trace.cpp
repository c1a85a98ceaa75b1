// tilepress memory-trace: the requests that memory sees, from a run that logged its blocks or a packed file.
#include "command_line.h"
#include "memory_trace/frame_trace.h"
#include "streams/ending_signals.h"
#include "streams/messages.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress memory-trace out/game-4711 -o game.gem5.gz\n"
    "  tilepress memory-trace out/game-4711 --raw -o game-raw.gem5.gz\n"
    "  tilepress memory-trace shots.tpk --request-bytes 32 --trace-clock 800 -o shots.dramsim3\n"
    "  tilepress memory-trace shots.tpk --trace-data -o shots.csv.zst\n"
    "\n"
    "run, replay and frames leave blocks.log in the folder of a run with --memory-trace FILE. This verb makes\n"
    "further traces of it.\n";

}  // namespace

int verb_memory_trace(int argc, char** argv) {
  CLI::App app("Writes the memory requests of a run or a packed file in the format of a DRAM simulator.");
  app.footer(kExamples);
  MemoryTraceOptions options;
  std::string source;
  ProgressMode progress = ProgressMode::kAuto;
  bool quiet = false;
  app.add_option("SOURCE", source, "Folder of a run with blocks.log, or a file that tilepress pack wrote")
      ->type_name("FOLDER|FILE")
      ->required();
  app.add_option("-o,--output", options.path, "File to write; .gz and .zst compress it; - for standard output")
      ->type_name("FILE")
      ->required();
  add_memory_trace_options(app, options, "");
  add_trace_refresh_option(app, options);
  add_progress_option(app, progress);
  app.add_flag("--force", options.force, "Replace the file if it exists");
  app.add_flag("-q,--quiet", quiet, "Print no progress and no summary");
  if (auto status = parse_command_line(app, argc, argv)) return *status;
  if (const auto settled = settle_trace_options(options); !settled) return fail_trace(settled.error());

  const auto frames = open_traced_frames(source);
  if (!frames) return fail(kExitFailed, frames.error());
  if (const auto known = check_traced_scheme((*frames)->model().scheme.name); !known)
    return fail(kExitFailed, about(source, known.error()));
  if ((*frames)->frames().empty()) return fail(kExitNothingCaptured, source + ": holds no frame");
  if (!options.scheme.empty() && options.scheme != (*frames)->model().scheme.text)
    return fail(kExitUsage, "--trace-scheme " + options.scheme + ": " + source + " holds " +
                                (*frames)->model().scheme.text);
  const auto written =
      write_frame_trace(options.path, options, **frames, quiet ? ProgressMode::kNever : progress);
  if (!written) return fail_trace(written.error());
  if (!quiet) show(*written);
  return kExitDone;
}

}  // namespace tilepress
