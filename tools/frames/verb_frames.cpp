// tilepress frames: a sequence of images through the schemes.
#include <unistd.h>

#include <filesystem>

#include "capture/output_folder.h"
#include "command_line.h"
#include "common_options.h"
#include "frames/dumped_frames.h"
#include "frames/frames_run.h"
#include "streams/ending_signals.h"
#include "summary_table.h"
#include "verb.h"
#include "way_out.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress frames -o out shots/*.png\n"
    "  tilepress frames -s vdcp -s ras:ycocg=1 --verify -o out shots/*.png\n"
    "  tilepress frames --size 720x1280 -o - frame-*.rgba > schemes.csv\n"
    "  tilepress frames -s vdcp --memory-trace shots.gem5.gz -o out shots/*.png\n"
    "  ffmpeg -i clip.mkv -f rawvideo -pix_fmt rgba - | tilepress frames --size 640x360 -o out -\n";

/// Removes dumped frames that have no rows. Threads write pixels before the rows of earlier frames.
void remove_raw_frames(const std::string& run_path) {
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(run_path + "/frames", code))
    if (entry.path().extension() == ".rgba") std::filesystem::remove(entry.path(), code);
}

std::string nothing_wanted_text(uint64_t frames) {
  return "--frames and --every select none of the frames 0.." + std::to_string(frames - 1);
}

bool wants_any(const RunOptions& options, uint64_t frames) {
  for (uint64_t number = 0; number < frames; ++number)
    if (options.takes(number)) return true;
  return false;
}

RunInfo run_info(int argc, char** argv, const WorkloadLabel& workload) {
  RunInfo info;
  info.command = {"tilepress"};
  info.command.insert(info.command.end(), argv, argv + argc);
  info.program = "tilepress";
  info.pid = getpid();
  info.via = "frames";
  info.further = workload.members();
  return info;
}

/// Closes a run that a signal ended.
int end_on_signal(int signal, const ImageFrames& images, const FramesOptions& options, FramesRun& run) {
  const RunCounts& counts = run.record().counts;
  std::string reason = std::to_string(counts.captured);
  if (!images.streamed()) reason += " of " + std::to_string(*images.count() - counts.skipped);
  reason += counts.captured == 1 && images.streamed() ? " frame captured" : " frames captured";
  auto closed = run.finish(state_after(signal), reason);
  if (closed && !options.to_stdout()) {
    closed = convert_dumped_frames(options.run.output);
    remove_raw_frames(options.run.output);
  }
  if (!closed) fail(kExitFailed, closed.error());
  return fail(128 + signal, signal_text(signal) + ": " + reason);
}

/// Closes a run that no signal ended.
int end_run(Result<void> done, const FramesOptions& options, FramesRun& run) {
  const RunRecord& record = run.record();
  if (done && run.mismatch()) done = *run.mismatch();
  const auto finished = run.finish(done ? "finished" : "failed", done ? "" : done.error().text);
  if (done && !finished) done = finished;
  if (done && !options.to_stdout()) done = convert_dumped_frames(options.run.output);
  if (!options.quiet && record.counts.captured > 0) {
    show(summary_table(record, "frames"));
    if (!options.to_stdout())
      show("  rows: " + options.run.output + "/schemes.csv and frames.csv\n" +
           next_command(options.run.output));
  }
  if (done && record.counts.captured > 0) done = run.write_memory_trace();
  if (!done) return fail(kExitFailed, done.error());
  if (record.counts.captured > 0) return kExitDone;
  return fail(kExitNothingCaptured,
              record.counts.seen == 0 ? "the input holds no frame" : nothing_wanted_text(record.counts.seen));
}

std::optional<int> parse(int argc, char** argv, FramesOptions& options) {
  CLI::App app(
      "Compresses a sequence of images, and writes frames.csv, schemes.csv and run.json.");
  app.footer(kExamples);
  add_run_options(app, options.run);
  app.add_option("IMAGE", options.images,
                 "Images or movies of 8 bits a channel, frame caches, raw .rgba files, or - for raw frames")
      ->type_name("...")
      ->required();
  add_workload_options(app, options.workload);
  add_size_option(app, "size", options.size, "Size of raw .rgba frames");
  app.add_option("-j,--jobs", options.jobs, "Number of threads (default: 1); the results are the same for any number")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  add_progress_option(app, options.progress);
  add_cdf_options(app, options.cdf_path, options.cdf_frames);
  add_memory_trace_options(app, options.trace, kRunTraceHelp);
  add_trace_refresh_option(app, options.trace);
  app.add_flag("--force", options.force, "Replace the run in the folder");
  app.add_flag("-q,--quiet", options.quiet, "Print no progress and no summary");
  if (const auto status = parse_command_line(app, argc, argv)) return status;
  options.trace.force = options.force;
  options.trace.path = options.trace.path_of(
      options.to_stdout() ? "frames"
                          : std::filesystem::path(absolute_folder(options.run.output)).filename().string());
  if (const auto asked = ask_for_trace(options.trace, options.run); !asked) return fail_trace(asked.error());
  return std::nullopt;
}

}  // namespace

int verb_frames(int argc, char** argv) {
  FramesOptions options;
  if (const auto status = parse(argc, argv, options)) return *status;
  ImageFrames images;
  const auto opened = images.open(options.images, options.size);
  if (const int signal = noted_signal(); signal != 0) return fail(128 + signal, signal_text(signal));
  if (!opened)
    return fail(opened.error().kind == ErrorKind::kBadValue ? kExitUsage : kExitFailed, opened.error());
  if (const auto count = images.count(); count && !wants_any(options.run, *count))
    return fail(kExitNothingCaptured, nothing_wanted_text(*count));

  FramesRun run(images, options);
  if (const auto begun = run.open(run_info(argc, argv, options.workload)); !begun)
    return fail(kExitFailed, begun.error());
  const auto done = run.process();
  const int signal = noted_signal();
  if (signal != 0 && !(done && *done)) return end_on_signal(signal, images, options, run);
  return end_run(done ? Result<void>() : done.error(), options, run);
}

}  // namespace tilepress
