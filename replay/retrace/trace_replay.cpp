// Trace replay: prepares, tries the roads, judges what came of it and puts the run in its place.
#include "tilepress/trace_replay.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <thread>

#include "frame_rows.h"
#include "replay_attempt.h"
#include "replay_road.h"
#include "tilepress/file_digest.h"
#include "tilepress/run_lock.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

std::mutex making_folders;  ///< of replays at work at a time, which share the output folder

std::string plural(uint64_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

const std::string* find_member(const RunInfo& info, const std::string& name) {
  for (const auto& [member, value] : info.further)
    if (member == name) return &value;
  return nullptr;
}

std::string absolute_path(const std::string& path) {
  std::error_code code;
  return fs::absolute(path, code).string();
}

/// Frames of the trace that the options take, counted per surface as the shim counts them.
uint64_t count_wanted(const TraceSummary& trace, const RunOptions& options) {
  if (options.frames.all() && options.every == 1) return trace.frames;
  uint64_t count = 0;
  for (const TraceSurface& surface : trace.surfaces)
    for (uint64_t frame = 0; frame < surface.frames; ++frame) count += options.takes(frame) ? 1 : 0;
  return count;
}

/// Renderer and worker want all cores by turns: with as many, hardly ever does one wait for the other.
constexpr uint32_t kQueueFrames = 8;

}  // namespace

struct TraceReplay::Attempt {
  ReplayRoad road;
  std::string folder;
  AttemptOutcome outcome;
  int stop_signal = 0;       ///< if that interrupted it
  RunRecord run{};           ///< the largest run of the attempt, a retracer makes one
  std::string run_folder{};  ///< where it still lies; empty if there is none
};

TraceReplay::TraceReplay(ReplayInput input, const ReplayOptions& options)
    : input_(std::move(input)), options_(options), run_options_(options.run) {
  if (input_.frames) run_options_.frames = *input_.frames;
  // A retracer that crashes can be started again: what is in the queue then may be more than in programs.
  run_options_.queue_frames = kQueueFrames;
  run_path_ = options.run.output + "/" + input_.name;
  partial_path_ = run_path_ + ".partial";
}

void TraceReplay::fail(std::string reason, ReplayStatus status) {
  result_.status = status;
  result_.reason = std::move(reason);
}

std::optional<uint64_t> TraceReplay::frames_wanted() const {
  const uint64_t frames = frames_wanted_.load(std::memory_order_relaxed);
  return frames == kUnknown ? std::nullopt : std::optional(frames);
}

bool TraceReplay::can_be_read_meanwhile() const {
  if (!input_.sha256.empty() || options_.resume || !run_options_.frames.all()) return false;
  std::string error;
  const auto roads = replay_roads(TraceApi::kUnknown, options_.retracer, options_.display, error);
  std::error_code code;
  return !roads.empty() && roads[0].display == ReplayDisplay::kSurfaceless &&
         !fs::exists(partial_path_, code) && !fs::exists(run_path_, code) && begins_as_trace(input_.path);
}

bool TraceReplay::prepare(TraceReading reading) {
  if (reading == TraceReading::kMeanwhile && can_be_read_meanwhile()) return true;
  return read_trace() && check_folder();
}

/// False, and failed, if the trace shows that it cannot or should not be replayed.
bool TraceReplay::read_trace() {
  std::string error;
  const std::optional<TraceSummary> trace = summarize_trace(input_.path, error);
  if (!trace) return fail(error), false;
  trace_ = *trace;
  result_.frames_in_trace = trace_.frames;
  if (trace_.state == TraceState::kCorrupt) {
    fail("corrupt at byte " + std::to_string(trace_.offset) + " of the stream, after " +
         plural(trace_.frames, "frame") + ": " + trace_.reason + "; not replayed");
    return false;
  }
  const std::optional<std::string> digest = sha256_of_file(input_.path, error);
  if (!digest) return fail(error), false;
  sha256_ = *digest;
  if (!input_.sha256.empty() && input_.sha256 != sha256_)
    return fail("has SHA-256 " + sha256_ + ", not " + input_.sha256 + " as the manifest says"), false;
  const bool triggered =
      run_options_.triggers != 0;  // then nobody knows beforehand how many frames there are
  if (trace_.frames == 0 && !triggered) {
    const std::string cut =
        trace_.state == TraceState::kTruncated ? "truncated (" + trace_.reason + "), " : "";
    fail(cut + "presents no frame (" + plural(trace_.calls, "call") + ", API " + name_of(trace_.api) + ")",
         ReplayStatus::kNothingCaptured);
    return false;
  }
  result_.frames_wanted = count_wanted(trace_, run_options_);
  if (result_.frames_wanted == 0 && !triggered) {
    fail("none of its " + plural(trace_.frames, "frame") + " is asked for", ReplayStatus::kNothingCaptured);
    return false;
  }
  if (replay_roads(trace_.api, options_.retracer, options_.display, error).empty()) return fail(error), false;
  frames_wanted_ = result_.frames_wanted;
  read_ = true;
  return true;
}

bool TraceReplay::check_folder() {
  std::error_code code;
  if (fs::exists(partial_path_, code)) {
    if (!options_.resume)
      return fail(partial_path_ + " is left of an interrupted replay (--resume replaces it)"), false;
    fs::remove_all(partial_path_, code);
  }
  if (!fs::exists(run_path_, code)) return true;
  if (!options_.resume)
    return fail(run_path_ + " exists already (--resume keeps it if it is the same replay)"), false;
  return keep_finished_run();
}

/// Options that change the rows: two replays with equal fingerprints give equal statistics.
std::string TraceReplay::fingerprint() const {
  return rows_fingerprint(run_options_) + " api=" + std::to_string(static_cast<int>(options_.retracer)) +
         " display=" + std::to_string(static_cast<int>(options_.display));
}

bool TraceReplay::keep_finished_run() {
  Result<RunRecord> read = read_run(run_path_);
  if (!read) return fail(read.error().text), false;
  RunRecord& run = *read;
  const std::string* trace = find_member(run.info, "trace_sha256");
  const std::string* options = find_member(run.info, "replay_options");
  if (trace == nullptr || options == nullptr || *trace != sha256_ || *options != fingerprint())
    return fail(run_path_ + " holds a run of another trace or with other options"), false;
  if (run_options_.triggers != 0) result_.frames_wanted = run.presented_frames();
  if (run.state == "finished" && run.presented_frames() == result_.frames_wanted) {
    result_.status = ReplayStatus::kKept;
    if (trace_.state == TraceState::kTruncated)
      fail("truncated after " + plural(trace_.frames, "frame") + ": " + trace_.reason + "; its run was kept");
    result_.frames_captured = run.presented_frames();
    frames_done_ = run.presented_frames();
    result_.run = std::move(run);
    return false;
  }
  options_.explain(input_.path + ": replayed again, the run in " + run_path_ + " is " + run.state);
  std::error_code code;
  fs::remove_all(run_path_, code);
  return true;
}

void TraceReplay::run(const std::atomic<int>& stop) {
  if (!make_folder()) return;
  std::string error;
  std::vector<ReplayRoad> roads =
      replay_roads(read_ ? trace_.api : TraceApi::kUnknown, options_.retracer, options_.display, error);
  for (size_t i = 0; i < roads.size(); ++i) {
    const std::string folder = partial_path_ + "/" + std::to_string(i);
    options_.explain(input_.path + ": " + roads[i].name() + " (" + roads[i].why + ")");
    Attempt attempt{roads[i], folder, attempt_road(roads[i], folder, stop)};
    if (!read_) break;
    if (attempt.outcome.interrupted) attempt.stop_signal = stop;
    // The first road is the same for all: which others there are, the trace tells.
    roads = replay_roads(trace_.api, options_.retracer, options_.display, error);
    find_run(attempt);
    judge(attempt);
    const bool last = i + 1 == roads.size() || !attempt.run.frames.empty() || attempt.outcome.interrupted ||
                      attempt.outcome.hung;
    if (last) {
      settle(attempt);
      break;
    }
    options_.explain(input_.path + ": " + result_.reason);
  }
  remove_folder();
}

bool TraceReplay::make_folder() {
  const std::lock_guard lock(making_folders);
  std::error_code code;
  for (fs::path path = options_.run.output; path.has_relative_path() && !fs::exists(path, code);
       path = path.parent_path())
    made_folders_.push_back(path.string());
  fs::create_directories(options_.run.output, code);
  if (!code && !fs::create_directory(partial_path_, code) && !code)
    code = std::make_error_code(std::errc::file_exists);
  if (code) fail(partial_path_ + ": " + code.message());
  return !code;
}

/// A trace that turned out not to be replayable leaves nothing, as if it had been read before.
void TraceReplay::remove_folder() {
  const std::lock_guard lock(making_folders);
  std::error_code code;
  fs::remove_all(partial_path_, code);
  for (const std::string& path : made_folders_)
    if (read_ || !fs::remove(path, code)) return;
}

AttemptOutcome TraceReplay::attempt_road(const ReplayRoad& road, const std::string& folder,
                                         const std::atomic<int>& stop) {
  AttemptOrder order;
  order.folder = folder;
  order.trace_path = absolute_path(input_.path);
  order.frames_wanted = result_.frames_wanted;
  for (const TraceSurface& surface : trace_.surfaces) {  // none while the trace is not read
    order.width = std::max(order.width, surface.width);
    order.height = std::max(order.height, surface.height);
    const auto last = run_options_.frames.last();
    order.may_stop_early = order.may_stop_early || (last && *last + 1 < surface.frames);
    // Rows are counted, and these would be counted with the rest.
    if (run_options_.all_targets || run_options_.triggers != 0) order.may_stop_early = false;
  }
  std::atomic<bool> hopeless{false};
  std::thread reader;
  if (!read_) reader = std::thread([&] { hopeless = !read_trace(); });
  const AttemptOutcome outcome = run_attempt(
      road, order, options_, run_options_, [&] { return stop || hopeless; }, frames_done_);
  if (reader.joinable()) reader.join();
  if (hopeless) frames_wanted_ = frames_done_ = 0;
  return outcome;
}

void TraceReplay::find_run(Attempt& attempt) {
  for (const std::string& folder : run_folders_in(attempt.folder + "/runs")) {
    wait_for_writer(folder, true);
    Result<RunRecord> run = read_run(folder);
    if (!run) {
      options_.explain(run.error().text);
      continue;
    }
    if (!attempt.run_folder.empty() && run->frames.size() <= attempt.run.frames.size()) continue;
    attempt.run = std::move(*run);
    attempt.run_folder = folder;
  }
}

/// Closes the run with what is known of the trace, and moves it into its place in one step.
void TraceReplay::settle(Attempt& attempt) {
  if (attempt.run.frames.empty()) return;
  RunEnd end;
  end.overrules = true;
  end.state = result_.frames_captured == result_.frames_wanted ? "finished" : "failed";
  if (result_.status == ReplayStatus::kInterrupted)
    end.state = "killed by signal " + std::to_string(attempt.stop_signal);
  end.reason = result_.reason;
  if (attempt.outcome.stopped_early && end.reason.empty())
    end.reason = "ended after the last frame asked for";
  end.exit_status = attempt.outcome.exit_status;
  if (!attempt.outcome.stopped_early) end.signal = attempt.outcome.signal;
  if (attempt.outcome.interrupted) end.signal = attempt.stop_signal;
  end.program = input_.name;
  end.via = "replay";
  end.further = {{"trace", fs::absolute(input_.path).string()},
                 {"trace_sha256", sha256_},
                 {"trace_program", trace_.program},
                 {"trace_api", name_of(trace_.api)},
                 {"retracer", attempt.road.name()},
                 {"replay_options", fingerprint()}};
  if (!input_.category.empty()) end.further.emplace_back("category", input_.category);
  end.figures = {{"trace_frames", trace_.frames}, {"expected_frames", result_.frames_wanted}};
  result_.run = std::move(attempt.run);
  if (const auto closed = close_run(end, result_.run); !closed) return fail(closed.error().text);
  std::error_code code;
  fs::rename(attempt.run_folder, run_path_, code);
  if (code) return fail(run_path_ + ": " + code.message());
  result_.run.path = run_path_;
}

/// How the retracer ended, as the end of a sentence; empty if it ended well.
std::string TraceReplay::end_text(const Attempt& attempt) const {
  const AttemptOutcome& outcome = attempt.outcome;
  const std::string& who = attempt.road.retracer;
  if (outcome.interrupted) return "interrupted";
  if (outcome.hung)
    return who + " showed no frame for " + std::to_string(options_.timeout.count()) + " s and was ended";
  if (outcome.stopped_early) return "";
  if (outcome.signal)
    return who + " was ended by signal " + std::to_string(*outcome.signal) + " (" +
           strsignal(*outcome.signal) + ")";
  if (outcome.exit_status.value_or(0) != 0)
    return who + " ended with status " + std::to_string(*outcome.exit_status);
  return "";
}

/// What became of the frames that are missing, as far as the shim tells.
std::string TraceReplay::missing_text(const Attempt& attempt) const {
  const RunCounts& counts = attempt.run.counts;
  std::string text;
  const auto add = [&text](uint64_t count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(counts.unsupported, "in an unsupported format");
  add(counts.not_captured, "could not be read back");
  add(counts.dropped, "dropped (queue full)");
  if (const std::string end = end_text(attempt); !end.empty()) text += (text.empty() ? "" : ", ") + end;
  if (text.empty() && attempt.run_folder.empty())
    text = attempt.outcome.seen.empty() ? attempt.road.retracer + " asked for no presenting function"
                                        : attempt.road.retracer + " presented nothing";
  if (text.empty()) text = attempt.road.retracer + " presented " + plural(counts.seen, "frame");
  return text;
}

void TraceReplay::judge(const Attempt& attempt) {
  const RunRecord& run = attempt.run;
  result_.seconds = attempt.outcome.seconds;
  const uint64_t captured = run.presented_frames();
  result_.frames_captured = captured;
  if (run_options_.triggers != 0 && !attempt.outcome.interrupted) result_.frames_wanted = captured;
  result_.retracer_lines.clear();
  const bool complete = captured == result_.frames_wanted && captured > 0 && run_options_.triggers == 0;
  if (attempt.outcome.interrupted && !complete)
    return fail("stopped after " + std::to_string(captured) + " of " + plural(result_.frames_wanted, "frame"),
                ReplayStatus::kInterrupted);
  if (!attempt.outcome.error.empty()) return fail(attempt.outcome.error);
  const std::string of = " of " + plural(result_.frames_wanted, "frame");
  uint64_t mismatched_blocks = 0;
  for (const FrameStatistics& frame : run.frames)
    for (const SchemeStatistics& scheme : frame.schemes) mismatched_blocks += scheme.mismatched_blocks;
  // A window that changes its shape goes on as a new surface, numbered from 0 again: then the numbers asked
  // for may fall on more or fewer frames than the trace let expect, but each one presented is accounted for.
  const bool all_accounted = result_.frames_wanted != trace_.frames && run.counts.seen == trace_.frames &&
                             captured + run.counts.skipped == trace_.frames && captured > 0;
  if (all_accounted) result_.frames_wanted = captured;
  if (captured == result_.frames_wanted && captured > 0) {
    if (mismatched_blocks > 0)
      return fail("--verify: " + plural(mismatched_blocks, "block") + " differ after decoding");
    if (trace_.state == TraceState::kTruncated)
      return fail("truncated after " + plural(trace_.frames, "frame") + ": " + trace_.reason +
                  "; the frames before were captured");
    if (const std::string end = end_text(attempt); !end.empty())
      options_.explain(input_.path + ": " + end + ", after the last frame");
    result_.status = ReplayStatus::kDone;
    result_.reason.clear();
    return;
  }
  result_.retracer_lines = attempt.outcome.last_lines;
  if (run.state == "failed" && !run.reason.empty())
    return fail("captured " + std::to_string(captured) + of + ": " + run.reason);
  if (captured == 0)
    return fail("no frame captured" + of + ": " + missing_text(attempt), ReplayStatus::kNothingCaptured);
  fail("captured " + std::to_string(captured) + of + ": " + missing_text(attempt));
}

}  // namespace tilepress
