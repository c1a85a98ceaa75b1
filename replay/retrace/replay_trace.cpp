// Replay trace: reads the trace, tries the roads, and moves the run into its place.
#include "tilepress/trace_replay.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "frame_rows.h"
#include "replay_attempt.h"
#include "replay_folder.h"
#include "replay_road.h"
#include "replay_verdict.h"
#include "tilepress/file_digest.h"
#include "tilepress/run_lock.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

/// Frames that may wait for the worker. The renderer and the worker take turns on all cores: with this many,
/// one rarely waits for the other. A crash loses them, but a crashed retracer can be started again.
constexpr uint32_t kQueueFrames = 8;

const std::string* find_member(const RunInfo& info, const std::string& name) {
  for (const auto& [member, value] : info.further)
    if (member == name) return &value;
  return nullptr;
}

/// Frames of the trace that the options take, counted per surface as the shim counts them.
uint64_t count_wanted(const TraceSummary& trace, const RunOptions& options) {
  if (options.frames.all() && options.every == 1) return trace.frames;
  uint64_t count = 0;
  for (const TraceSurface& surface : trace.surfaces)
    for (uint64_t frame = 0; frame < surface.frames; ++frame) count += options.takes(frame) ? 1 : 0;
  return count;
}

/// The largest run below `folder`; a retracer makes one.
std::optional<RunRecord> largest_run(const std::string& folder) {
  std::optional<RunRecord> largest;
  for (const std::string& path : run_folders_in(folder)) {
    wait_for_writer(path, true);
    Result<RunRecord> run = read_run(path);
    if (!run)
      spdlog::info("{}", run.error().text);
    else if (!largest || run->frames.size() > largest->frames.size())
      largest = std::move(*run);
  }
  return largest;
}

AttemptOrder order_for(const std::string& trace_path, const std::string& folder, const TraceSummary& trace,
                       uint64_t frames_wanted, const RunOptions& options) {
  AttemptOrder order;
  std::error_code code;
  order.trace_path = fs::absolute(trace_path, code).string();
  order.folder = folder;
  order.frames_wanted = frames_wanted;
  const auto last = options.frames.last();
  for (const TraceSurface& surface : trace.surfaces) {  // none while the trace is not read
    order.width = std::max(order.width, surface.width);
    order.height = std::max(order.height, surface.height);
    order.may_stop_early = order.may_stop_early || (last && *last + 1 < surface.frames);
  }
  // The rows of targets and triggers cannot be told from those of the frames that are counted.
  if (options.all_targets || options.triggers != 0) order.may_stop_early = false;
  return order;
}

}  // namespace

TraceReplay::TraceReplay(ReplayInput input, const ReplayOptions& options)
    : input_(std::move(input)),
      options_(options),
      run_options_(options.run),
      folder_(std::make_unique<ReplayFolder>(options.run.output, input_.name)) {
  if (input_.frames) run_options_.frames = *input_.frames;
  run_options_.queue_frames = kQueueFrames;
}

TraceReplay::~TraceReplay() = default;

bool TraceReplay::fail(std::string reason, ReplayStatus status) {
  result_.status = status;
  result_.reason = std::move(reason);
  return false;
}

std::optional<uint64_t> TraceReplay::frames_wanted() const {
  const uint64_t frames = frames_wanted_.load(std::memory_order_relaxed);
  return frames == kUnknown ? std::nullopt : std::optional(frames);
}

bool TraceReplay::prepare(TraceReading reading) {
  if (reading == TraceReading::kMeanwhile && can_be_read_meanwhile()) return true;
  return read_trace() && check_folder();
}

bool TraceReplay::can_be_read_meanwhile() const {
  if (!input_.sha256.empty() || options_.resume || !run_options_.frames.all()) return false;
  const auto roads = replay_roads(TraceApi::kUnknown, options_.retracer, options_.display);
  return roads && roads->front().display == ReplayDisplay::kSurfaceless && !folder_->exists() &&
         begins_as_trace(input_.path);
}

bool TraceReplay::read_trace() {
  const Result<TraceSummary> trace = summarize_trace(input_.path);
  if (!trace) return fail(trace.error().text);
  trace_ = *trace;
  result_.frames_in_trace = trace_.frames;
  const std::string frames_text = plural(trace_.frames, "frame");
  if (trace_.state == TraceState::kCorrupt)
    return fail("corrupt at byte " + std::to_string(trace_.offset) + " of the stream, after " + frames_text +
                ": " + trace_.reason + "; not replayed");
  const Result<std::string> digest = sha256_of_file(input_.path);
  if (!digest) return fail(digest.error().text);
  sha256_ = *digest;
  if (!input_.sha256.empty() && input_.sha256 != sha256_)
    return fail("has SHA-256 " + sha256_ + ", not " + input_.sha256 + " as the manifest says");
  const bool triggered = run_options_.triggers != 0;  // the trace does not say how many frames they make
  if (trace_.frames == 0 && !triggered) {
    const std::string cut =
        trace_.state == TraceState::kTruncated ? "truncated (" + trace_.reason + "), " : "";
    return fail(
        cut + "presents no frame (" + plural(trace_.calls, "call") + ", API " + name_of(trace_.api) + ")",
        ReplayStatus::kNothingCaptured);
  }
  result_.frames_wanted = count_wanted(trace_, run_options_);
  if (result_.frames_wanted == 0 && !triggered)
    return fail("--frames and --every select none of its " + frames_text, ReplayStatus::kNothingCaptured);
  const auto roads = replay_roads(trace_.api, options_.retracer, options_.display);
  if (!roads) return fail(roads.error().text);
  frames_wanted_ = result_.frames_wanted;
  read_ = true;
  return true;
}

bool TraceReplay::check_folder() {
  std::error_code code;
  if (fs::exists(folder_->partial_path(), code)) {
    if (!options_.resume)
      return fail(folder_->partial_path() + " is left of an interrupted replay (--resume or --force replaces it)");
    fs::remove_all(folder_->partial_path(), code);
  }
  if (!fs::exists(folder_->run_path(), code)) return true;
  if (!options_.resume)
    return fail(folder_->run_path() +
                " exists already (--resume keeps it if it is the same replay, --force replaces it)");
  return keep_finished_run();
}

/// Options that change the rows: two replays with equal fingerprints give equal statistics.
std::string TraceReplay::fingerprint() const {
  return rows_fingerprint(run_options_) + " api=" + std::to_string(static_cast<int>(options_.retracer)) +
         " display=" + std::to_string(static_cast<int>(options_.display));
}

/// Returns true if the run is to be replayed again, and removes it then.
bool TraceReplay::keep_finished_run() {
  const std::string& path = folder_->run_path();
  Result<RunRecord> read = read_run(path);
  if (!read) return fail(read.error().text);
  RunRecord& run = *read;
  const std::string* trace = find_member(run.info, "trace_sha256");
  const std::string* options = find_member(run.info, "replay_options");
  if (trace == nullptr || options == nullptr || *trace != sha256_ || *options != fingerprint())
    return fail(path + " holds a run of another trace or with other options");
  if (run_options_.triggers != 0) result_.frames_wanted = run.presented_frames();
  if (run.state != "finished" || run.presented_frames() != result_.frames_wanted) {
    spdlog::info("{}: replayed again, because the run in {} is {}", input_.path, path, run.state);
    std::error_code code;
    fs::remove_all(path, code);
    return true;
  }
  result_.status = ReplayStatus::kKept;
  if (trace_.state == TraceState::kTruncated)
    fail("truncated after " + plural(trace_.frames, "frame") + ": " + trace_.reason + "; its run was kept");
  result_.frames_captured = run.presented_frames();
  frames_done_ = run.presented_frames();
  result_.run = std::move(run);
  return false;
}

void TraceReplay::run(const std::atomic<int>& stop) {
  if (const auto made = folder_->make(); !made) {
    fail(made.error().text);
    return;
  }
  bool over = false;
  for (size_t i = 0; !over; ++i) {
    // The first road is the same for every trace. The trace, read by then, decides about the second.
    const auto roads =
        replay_roads(read_ ? trace_.api : TraceApi::kUnknown, options_.retracer, options_.display);
    if (!roads || i == roads->size()) break;
    if (i > 0) spdlog::info("{}: {}", input_.path, result_.reason);
    over = try_road((*roads)[i], folder_->partial_path() + "/" + std::to_string(i), stop);
  }
  folder_->remove(!read_);  // a trace that cannot be replayed leaves nothing, whenever it was read
}

/// Returns false if another road may do better.
bool TraceReplay::try_road(const ReplayRoad& road, const std::string& folder, const std::atomic<int>& stop) {
  spdlog::info("{}: {} ({})", input_.path, road.name(), road.why);
  result_.retracer_lines.clear();
  result_.seconds = 0;
  const Result<AttemptOutcome> outcome = read_and_attempt(road, folder, stop);
  if (!read_) return true;
  if (!outcome) return fail(outcome.error().text);
  const int stop_signal = stop;
  std::optional<RunRecord> run = largest_run(folder + "/runs");
  const ReplayEvidence evidence{trace_,        run_options_, result_.frames_wanted, options_.timeout,
                                road.retracer, *outcome,     run ? &*run : nullptr};
  result_ = judge(evidence);
  const std::string end = end_text(evidence);
  if (result_.status == ReplayStatus::kDone && !end.empty())
    spdlog::info("{}: {}, after the last frame", input_.path, end);
  if (!run || run->frames.empty()) return outcome->interrupted || outcome->hung;
  settle(road, *outcome, std::move(*run), stop_signal);
  return true;
}

/// Attempts the replay, and reads the trace meanwhile unless it is read.
Result<AttemptOutcome> TraceReplay::read_and_attempt(const ReplayRoad& road, const std::string& folder,
                                                     const std::atomic<int>& stop) {
  const AttemptOrder order = order_for(input_.path, folder, trace_, result_.frames_wanted, run_options_);
  std::atomic<bool> hopeless{false};
  std::thread reader;
  if (!read_) reader = std::thread([&] { hopeless = !read_trace(); });
  Result<AttemptOutcome> outcome = run_attempt(
      road, order, options_, run_options_, [&] { return stop || hopeless; }, frames_done_);
  if (reader.joinable()) reader.join();
  if (hopeless) frames_wanted_ = frames_done_ = 0;
  return outcome;
}

/// Closes the run with what is known of the trace, and moves it into its place in one step.
void TraceReplay::settle(const ReplayRoad& road, const AttemptOutcome& outcome, RunRecord run,
                         int stop_signal) {
  RunEnd end;
  end.overrules = true;
  end.state = result_.frames_captured == result_.frames_wanted ? "finished" : "failed";
  if (result_.status == ReplayStatus::kInterrupted)
    end.state = "killed by signal " + std::to_string(stop_signal);
  end.reason = result_.reason;
  if (outcome.stopped_early && end.reason.empty()) end.reason = "ended after the last frame asked for";
  end.exit_status = outcome.exit_status;
  if (!outcome.stopped_early) end.signal = outcome.signal;
  if (outcome.interrupted) end.signal = stop_signal;
  end.program = input_.name;
  end.via = "replay";
  end.further = {{"trace", fs::absolute(input_.path).string()},
                 {"trace_sha256", sha256_},
                 {"trace_program", trace_.program},
                 {"trace_api", name_of(trace_.api)},
                 {"retracer", road.name()},
                 {"replay_options", fingerprint()}};
  if (!input_.category.empty()) end.further.emplace_back("category", input_.category);
  end.figures = {{"trace_frames", trace_.frames}, {"expected_frames", result_.frames_wanted}};
  const std::string folder = run.path;
  result_.run = std::move(run);
  if (const auto closed = close_run(end, result_.run); !closed) {
    fail(closed.error().text);
    return;
  }
  std::error_code code;
  fs::rename(folder, folder_->run_path(), code);
  if (code)
    fail(folder_->run_path() + ": " + code.message());
  else
    result_.run.path = folder_->run_path();
}

}  // namespace tilepress
