// tilepress frames: a sequence of images through the schemes.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "frames/cdf_file.h"
#include "command_line.h"
#include "common_options.h"
#include "frames/dumped_frames.h"
#include "frames/frame_batch.h"
#include "frames/image_frames.h"
#include "progress_line.h"
#include "streams/standard_streams.h"
#include "summary_table.h"
#include "tilepress/frame_pictures.h"
#include "tilepress/run_directory.h"
#include "tilepress/statistics_rows.h"
#include "verb.h"

namespace tilepress {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress frames -o out shots/*.png\n"
    "  tilepress frames -s vdcp -s ras:ycocg=1 --verify -o out shots/*.png\n"
    "  tilepress frames --size 720x1280 -o - frame-*.rgba > schemes.csv\n"
    "  ffmpeg -i clip.mkv -f rawvideo -pix_fmt rgba - | tilepress frames --size 640x360 -o out -\n";

struct FramesOptions {
  RunOptions run;
  std::vector<std::string> images;
  std::optional<FrameSize> size;
  ProgressMode progress = ProgressMode::kAuto;
  uint32_t jobs = 1;
  std::string cdf_path;  ///< empty = none
  FrameSet cdf_frames;
  bool force = false;
  bool quiet = false;
  bool wants_cdf(uint64_t frame) const { return !cdf_path.empty() && cdf_frames.contains(frame); }
  bool to_stdout() const { return run.output == "-"; }
};

/// Where rows go: a run directory, or schemes.csv on standard output.
class RowSink {
 public:
  bool open(const FramesOptions& options, const RunInfo& info, std::string& error) {
    for (const SchemeSpec& spec : options.run.schemes) names_.push_back(spec.text);
    if (options.to_stdout()) return print(schemes_csv_header(), error);
    if (options.force)
      for (const char* name : {"/frames.csv", "/schemes.csv", "/run.json"})
        unlink((options.run.output + name).c_str());
    const auto created = writer_.create(options.run.output, info, options.run);
    if (created) return true;
    error = created.error().text;
    if (created.error().kind == ErrorKind::kExists) error += " (--force replaces it)";
    return false;
  }
  bool append(const FrameStatistics& frame, std::string& error) {
    if (!writer_.is_open()) {
      text_.clear();
      append_schemes_rows(frame, names_, text_);
      return print(text_, error);
    }
    const auto appended = writer_.append(frame);
    if (!appended) error = appended.error().text;
    return static_cast<bool>(appended);
  }
  bool finish(const RunCounts& counts, const std::string& state, const std::string& reason,
              std::string& error) {
    if (!writer_.is_open()) return true;
    writer_.set_counts(counts);
    const auto finished = writer_.finish(state, reason);
    if (!finished && error.empty()) error = finished.error().text;
    return static_cast<bool>(finished);
  }

 private:
  bool print(const std::string& text, std::string& error) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return flush_standard_output(error);
  }
  RunWriter writer_;
  std::vector<std::string> names_;
  std::string text_;
};

/// Adds a frame to what the summary shows, and its rows to the sink.
bool take(const FrameStatistics& statistics, RowSink& sink, RunRecord& record, std::string& error) {
  ++record.counts.seen;
  ++record.counts.captured;
  if (!sink.append(statistics, error)) return false;
  record.measured_frames += statistics.warmup ? 0 : 1;
  for (size_t i = 0; i < record.totals.size(); ++i) {
    const SchemeStatistics& scheme = statistics.schemes[i];
    if (!statistics.warmup) record.totals[i] += scheme;
    if (scheme.mismatched_blocks > 0)
      record.reason = "--verify: " + record.scheme_names[i] + ": frame " + std::to_string(statistics.frame) +
                      ": " + std::to_string(scheme.mismatched_blocks) + " blocks differ after decoding";
  }
  if (record.frames.empty()) record.frames.push_back(statistics);
  return true;
}

SurfaceView view_of(const ImageFrames& images, const ImageFrame& frame) {
  return {frame.pixels.data(), static_cast<ptrdiff_t>(images.size().width) * 4,
          images.size().width, images.size().height,
          images.format(),     ByteOrder::kRgba};
}

/// Frames of pipes, movies and animations: in order, each once, their number not known before.
bool process_stream(ImageFrames& images, const FramesOptions& options, RowSink& sink, CdfFile& cdf,
                    RunRecord& record, ProgressLine& progress, std::string& error) {
  SurfaceEngine engine(options.run.schemes, options.run.model);
  FramePictures pictures;
  if (!options.to_stdout()) pictures.open(options.run.output, options.run);
  const auto begin = std::chrono::steady_clock::now();
  FrameStatistics statistics;
  ImageFrame frame;
  const auto last = options.run.frames.last();
  for (uint64_t number = 0; !last || number <= *last; ++number) {
    const auto outcome = images.read(number, frame, error);
    if (outcome != ImageFrames::Outcome::kFrame) return outcome == ImageFrames::Outcome::kEnd;
    if (!options.run.takes(number)) {
      ++record.counts.seen;
      ++record.counts.skipped;
      continue;
    }
    statistics.frame = number;
    statistics.time_ns = static_cast<uint64_t>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begin)
            .count());
    statistics.readback_ns = frame.decode_ns;
    const SurfaceView view = view_of(images, frame);
    engine.note_block_bits(pictures.bits_for(number));
    engine.process(view, statistics);
    if (const auto written = pictures.write(statistics, view); !written) {
      error = written.error().text;
      return false;
    }
    if (options.wants_cdf(number) && !cdf.append(statistics, view, error)) return false;
    if (!take(statistics, sink, record, error) || noted_signal() != 0) return false;
    progress.show(number + 1, {});
  }
  return true;
}

/// Runs all frames. Fills `record` with what the summary shows; returns false and one line in `error` on
/// failure.
bool process_frames(ImageFrames& images, const FramesOptions& options, RowSink& sink, CdfFile& cdf,
                    RunRecord& record, std::string& error) {
  ProgressLine progress(options.quiet ? ProgressMode::kNever : options.progress, "frames");
  for (const SchemeSpec& spec : options.run.schemes) record.scheme_names.push_back(spec.text);
  record.totals.assign(options.run.schemes.size(), SchemeStatistics{});
  for (SchemeStatistics& total : record.totals) total.burst_bits = options.run.model.burst_bits;
  if (images.streamed()) return process_stream(images, options, sink, cdf, record, progress, error);
  std::vector<uint64_t> numbers;
  for (uint64_t number = 0; number < *images.count(); ++number)
    if (options.run.takes(number)) numbers.push_back(number);
  record.counts.skipped = *images.count() - numbers.size();
  record.counts.seen = record.counts.skipped;
  ImageFrames cdf_images = images.another();
  ImageFrame cdf_frame;
  const auto deliver = [&](const FrameStatistics& statistics) {
    if (!take(statistics, sink, record, error)) return false;
    // The batch keeps no pixels: the few frames whose colours are asked for are decoded once more.
    if (options.wants_cdf(statistics.frame) &&
        (cdf_images.read(statistics.frame, cdf_frame, error) != ImageFrames::Outcome::kFrame ||
         !cdf.append(statistics, view_of(cdf_images, cdf_frame), error)))
      return false;
    progress.show(record.counts.captured, numbers.size());
    return noted_signal() == 0 || record.counts.captured == numbers.size();
  };
  return run_frame_batch(images, numbers, options.run, options.to_stdout() ? "" : options.run.output,
                         options.jobs, noted_signal(), deliver, error);
}

/// Removes dumped frames that have no rows: threads write them before the rows of earlier frames.
void remove_raw_frames(const std::string& run_path) {
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(run_path + "/frames", code))
    if (entry.path().extension() == ".rgba") std::filesystem::remove(entry.path(), code);
}

/// Closes the run of a verb that a signal ended: the rows of each frame are whole.
int end_on_signal(int signal, const ImageFrames& images, const FramesOptions& options, RowSink& sink,
                  const RunRecord& record) {
  std::string reason = std::to_string(record.counts.captured);
  if (!images.streamed()) reason += " of " + std::to_string(*images.count() - record.counts.skipped);
  reason += record.counts.captured == 1 && images.streamed() ? " frame captured" : " frames captured";
  std::string error;
  bool good = sink.finish(record.counts, state_after(signal), reason, error);
  if (good && !options.to_stdout()) {
    good = convert_dumped_frames(options.run.output, error);
    remove_raw_frames(options.run.output);
  }
  if (!good) fail(kExitFailed, error);
  return fail(128 + signal, signal_text(signal) + ": " + reason);
}

int parse(int argc, char** argv, FramesOptions& options, std::optional<int>& status) {
  CLI::App app(
      "Takes frames from images, in the order given, and writes frames.csv, schemes.csv and run.json.");
  app.footer(kExamples);
  add_run_options(app, options.run);
  app.add_option("IMAGE", options.images,
                 "Images or movies of 8 bits a channel, raw .rgba files, or - for raw frames")
      ->type_name("...")
      ->required();
  add_size_option(app, "size", options.size, "Size of raw .rgba frames");
  app.add_option("-j,--jobs", options.jobs, "Threads (default: 1); the results are the same for any number")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  app.add_option_function<std::string>(
         "--progress",
         [&](const std::string& text) {
           const auto mode = parse_progress_mode(text);
           if (!mode) throw CLI::ValidationError("--progress " + text + ": not one of auto, never, json");
           options.progress = *mode;
         },
         "Progress on standard error (default: auto, a line on a terminal)")
      ->type_name("auto|never|json");
  add_cdf_options(app, options.cdf_path, options.cdf_frames);
  app.add_flag("--force", options.force, "Replace the run that the folder holds");
  app.add_flag("-q,--quiet", options.quiet, "No progress and no summary");
  status = parse_command_line(app, argc, argv);
  return 0;
}

}  // namespace

int verb_frames(int argc, char** argv) {
  FramesOptions options;
  std::optional<int> status;
  parse(argc, argv, options, status);
  if (status) return *status;

  std::string error;
  ImageFrames images;
  const bool opened = images.open(options.images, options.size, error);
  if (const int signal = noted_signal(); signal != 0) return fail(128 + signal, signal_text(signal));
  if (!opened) return fail(error.ends_with("--size WxH") ? kExitUsage : kExitFailed, error);
  if (const auto count = images.count()) {
    uint64_t wanted = 0;
    for (uint64_t number = 0; number < *count && wanted == 0; ++number) wanted += options.run.takes(number);
    if (wanted == 0)
      return fail(kExitNothingCaptured,
                  "--frames and --every select none of the frames 0.." + std::to_string(*count - 1));
  }

  RunInfo info;
  info.command.assign(argv, argv + argc);
  info.command.insert(info.command.begin(), "tilepress");
  info.program = "tilepress";
  info.pid = getpid();
  info.via = "frames";
  RowSink sink;
  CdfFile cdf;
  if (!options.cdf_path.empty() && !cdf.open(options.cdf_path, options.force, error))
    return fail(kExitFailed, error);
  if (!sink.open(options, info, error)) return fail(kExitFailed, error);
  RunRecord record;
  bool good = process_frames(images, options, sink, cdf, record, error);
  if (const int signal = noted_signal(); !good && signal != 0)
    return end_on_signal(signal, images, options, sink, record);
  if (good && !record.reason.empty()) {
    error = record.reason;
    good = false;
  }
  good = sink.finish(record.counts, good ? "finished" : "failed", error, error) && good;
  if (good && !options.to_stdout()) good = convert_dumped_frames(options.run.output, error);
  if (!options.quiet && record.counts.captured > 0) {
    std::string title = "frames";
    std::fputs(summary_table(record, title).c_str(), stderr);
    if (!options.to_stdout())
      std::fprintf(stderr, "  rows: %s/schemes.csv and frames.csv\n", options.run.output.c_str());
  }
  if (!good) return fail(kExitFailed, error);
  if (record.counts.captured == 0)
    return fail(kExitNothingCaptured, record.counts.seen == 0
                                          ? "no frame came"
                                          : "--frames and --every select none of the frames 0.." +
                                                std::to_string(record.counts.seen - 1));
  return kExitDone;
}

}  // namespace tilepress
