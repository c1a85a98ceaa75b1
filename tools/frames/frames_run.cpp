// Frames run: streams run on this thread, all other sequences as a batch.
#include "frames/frames_run.h"

#include <unistd.h>

#include <cstdio>

#include "frames/frame_batch.h"
#include "frames/frame_notes.h"
#include "frames/stop_watch.h"
#include "frames/verify_error.h"
#include "memory_trace/frame_trace.h"
#include "streams/ending_signals.h"
#include "streams/messages.h"
#include "streams/standard_streams.h"
#include "tilepress/plugin_scheme.h"
#include "tilepress/scheme.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {

static Result<void> print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  return flush_standard_output();
}

Result<void> RowSink::open(const RunOptions& options, const RunInfo& info, bool force) {
  for (const SchemeSpec& spec : options.schemes) scheme_names_.push_back(spec.text);
  if (options.output == "-") return print(schemes_csv_header());
  if (force)
    for (const char* name : {"/frames.csv", "/schemes.csv", "/run.json", "/blocks.log"})
      unlink((options.output + name).c_str());
  const auto created = writer_.create(options.output, info, options);
  if (!created && created.error().kind == ErrorKind::kExists)
    return Error{ErrorKind::kExists, created.error().text + " (--force replaces it)"};
  return created;
}

Result<void> RowSink::append(const FrameStatistics& frame) {
  if (writer_.is_open()) return writer_.append(frame);
  text_.clear();
  append_schemes_rows(frame, scheme_names_, text_);
  return print(text_);
}

Result<void> RowSink::finish(const RunCounts& counts, const std::string& state, const std::string& reason) {
  if (!writer_.is_open()) return {};
  writer_.set_counts(counts);
  return writer_.finish(state, reason);
}

FramesRun::FramesRun(ImageFrames& images, const FramesOptions& options)
    : images_(images),
      options_(options),
      progress_(options.quiet ? ProgressMode::kNever : options.progress, "frames") {
  record_.begin_sums(options.run);
}

Result<void> FramesRun::open(const RunInfo& info) {
  if (!options_.cdf_path.empty())
    if (const auto opened = cdf_.open(options_.cdf_path, options_.force); !opened) return opened;
  if (const auto opened = sink_.open(options_.run, info, options_.force); !opened) return opened;
  if (!options_.run.block_log.empty() && options_.to_stdout())
    if (const auto made = log_folder_.create(); !made) return made;
  return block_log_.create(log_folder(), options_.run);
}

Result<bool> FramesRun::process() {
  for (const std::string& line : unsupported_schemes(options_.run.schemes, images_.format()))
    say(MessageLevel::kWarning, line);
  return images_.streamed() ? catch_plugin_fault([this] { return process_stream(); }) : process_batch();
}

/// Writes the rows of a frame and adds the frame to the sums.
Result<void> FramesRun::take(const FrameStatistics& statistics, const std::string& log_record) {
  if (const auto logged = block_log_.append(log_record); !logged) return logged;
  ++record_.counts.seen;
  ++record_.counts.captured;
  if (const auto appended = sink_.append(statistics); !appended) return appended;
  record_.add_to_sums(statistics);
  for (size_t i = 0; i < record_.scheme_names.size(); ++i)
    if (const uint64_t blocks = statistics.schemes[i].mismatched_blocks; blocks > 0)
      mismatch_ = verify_error(record_.scheme_names[i], statistics.frame, blocks);
  if (record_.frames.empty()) record_.frames.push_back(statistics);
  return {};
}

Result<void> FramesRun::write_memory_trace() {
  if (!block_log_.is_open()) return {};
  const auto frames = open_logged_frames(log_folder() + "/" + std::string(kBlockLogName), false);
  if (!frames) return frames.error();
  const auto written = write_frame_trace(options_.trace.path, options_.trace, **frames,
                                         options_.quiet ? ProgressMode::kNever : options_.progress);
  if (!written) return written.error();
  if (!options_.quiet) show(*written);
  return {};
}

Result<bool> FramesRun::process_stream() {
  SurfaceEngine engine(options_.run.schemes, options_.run.model);
  FrameNotes notes(options_.run, options_.to_stdout() ? "" : options_.run.output, block_log_);
  const StopWatch clock;
  FrameStatistics statistics;
  ImageFrame frame;
  const auto last = options_.run.frames.last();
  for (uint64_t number = 0; !last || number <= *last; ++number) {
    const auto read = images_.read(number, frame);
    if (!read) return read;
    if (!*read) return true;
    if (!options_.run.takes(number)) {
      ++record_.counts.seen;
      ++record_.counts.skipped;
      continue;
    }
    statistics.frame = number;
    statistics.time_ns = clock.nanoseconds();
    statistics.readback_ns = frame.decode_ns;
    const SurfaceView view = images_.view(frame);
    const auto record = notes.process(engine, view, statistics);
    if (!record) return record.error();
    if (options_.wants_cdf(number))
      if (const auto appended = cdf_.append(statistics, view); !appended) return appended.error();
    if (const auto taken = take(statistics, *record); !taken) return taken.error();
    if (noted_signal() != 0) return false;
    progress_.show(number + 1, {});
  }
  return true;
}

Result<bool> FramesRun::process_batch() {
  std::vector<uint64_t> numbers;
  for (uint64_t number = 0; number < *images_.count(); ++number)
    if (options_.run.takes(number)) numbers.push_back(number);
  record_.counts.skipped = record_.counts.seen = *images_.count() - numbers.size();
  ImageFrames cdf_images = images_.another();
  ImageFrame cdf_frame;
  const auto deliver = [&](const FrameStatistics& statistics, const std::string& record) -> Result<bool> {
    if (const auto taken = take(statistics, record); !taken) return taken.error();
    if (options_.wants_cdf(statistics.frame)) {
      // The batch keeps no pixels: these few frames are decoded a second time.
      const auto read = cdf_images.read(statistics.frame, cdf_frame);
      if (!read || !*read) return read;
      const auto appended = cdf_.append(statistics, cdf_images.view(cdf_frame));
      if (!appended) return appended.error();
    }
    progress_.show(record_.counts.captured, numbers.size());
    return noted_signal() == 0 || record_.counts.captured == numbers.size();
  };
  return run_frame_batch(images_, numbers, options_.run, options_.to_stdout() ? "" : options_.run.output,
                         block_log_, options_.jobs, noted_signal(), deliver);
}

}  // namespace tilepress
