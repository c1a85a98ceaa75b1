// Capture worker: one frame at a time, in the order of presentation.
#include "interposer/engine/worker/capture_worker.h"

#include <sched.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "interposer/engine/worker/frame_dump.h"
#include "interposer/engine/monotonic_clock.h"
#include "interposer/run/descriptors.h"
#include "tilepress/session_mark.h"
#include "tilepress/shared_folder.h"

namespace tilepress {
namespace {

constexpr const char* kPresentColumns =
    "frame,surface,readback_ns,read_ns,wait_ns,damage,bind_ns,hand_off_ns,interval_ns,cause,readback\n";
constexpr const char* kSurfaceColumns = "surface,role,origin,width,height,format,color_space\n";

const char* name_of(ReadWay way) {
  switch (way) {
    case ReadWay::kAsync:
      return "async";
    case ReadWay::kBoth:
      return "both";
    case ReadWay::kInContext:
      return "in-context";
    default:
      return "sync";
  }
}

}  // namespace

void RoleCounts::raise(Count count, uint64_t by) {
  const uint64_t now = (counts_.*count += by);
  LiveCounts* shared = shared_;
  if (shared == nullptr) return;
  std::atomic<uint64_t>& shown = shared->*count;
  for (uint64_t before = shown; before < now && !shown.compare_exchange_weak(before, now);) {
  }
}

RunCounts RoleCounts::now() const {
  return {counts_.seen,    counts_.captured,    counts_.dropped,
          counts_.skipped, counts_.unsupported, counts_.not_captured};
}

void RoleCounts::show_in(LiveCounts* shared) {
  shared_ = shared;
  if (shared == nullptr) return;
  for (const Count count : {&LiveCounts::seen, &LiveCounts::captured, &LiveCounts::dropped,
                            &LiveCounts::skipped, &LiveCounts::unsupported, &LiveCounts::not_captured})
    raise(count, 0);
}

void RoleCounts::settle() {
  const RunCounts known = now();
  const uint64_t traced =
      known.captured + known.dropped + known.skipped + known.unsupported + known.not_captured;
  if (known.seen > traced) raise(&LiveCounts::not_captured, known.seen - traced);
}

CaptureWorker::CaptureWorker(const RunOptions& options, const RunInfo& info, CaptureCounts& counts,
                             const ShimLog& log)
    : options_(options), info_(info), counts_(counts), log_(log), queue_(options.queue_frames, [this] {
        return task_.program_gone();
      }) {}

bool CaptureWorker::start() {
  alive_ = thread_.start("tilepress", [this] { run(); });
  return alive_;
}

void CaptureWorker::run() {
  bool ended = false;
  task_.run([&] {
    if (task_.obstacle() != nullptr)
      log_.write(LogLevel::kDebug, std::string("frames are compressed on a thread: ") + task_.obstacle());
    work_until_closed();
    ended = true;
  });
  if (ended) return;
  // Nobody is left to take frames: no thread of the program may wait for room.
  log_.write(LogLevel::kError, "the capture has been killed");
  alive_ = false;
  while (!queue_.close()) {
  }
}

void CaptureWorker::work_until_closed() {
  // Frames may be dropped so that the program is not held up: then it is not held up by our use of the cores
  // either.
  const sched_param none{};
  if (options_.on_full == OnFull::kDrop) sched_setscheduler(0, SCHED_IDLE, &none);
  leave_descriptors_of_program();
  try {
    // The last turn comes after the queue was found closed: presents without a frame may have been counted
    // since the turn before.
    for (bool last = false; !last;) {
      last = queue_.closed_and_empty();
      take(last ? nullptr : queue_.next());
      task_.note_progress();
    }
    end_run();
  } catch (const std::exception& error) {
    give_up(error.what());
  }
  yielding_.end();
}

void CaptureWorker::take(CapturedFrame* frame) {
  if (!writer_.is_open() && alive() && counts_.presented.seen() + counts_.targets.seen() > 0) {
    if (const auto created = create_directory(); !created) give_up(created.error().text);
    opened_ = true;
    opened_changed_.notify_all();
  }
  if (frame != nullptr) {
    if (frame->last_of_window)
      surfaces_.erase(frame->window);
    else if (frame->lost)
      counts_.of(frame->role).raise(&LiveCounts::not_captured);
    else if (alive())
      process(*frame);
    queue_.done(frame);
  }
  if (writer_.is_open()) publish_counts();
}

void CaptureWorker::end_run() {
  if (!alive() || !writer_.is_open()) return;
  const bool gone = task_.program_gone();
  if (gone) {
    writer_.program_has_ended();
    counts_.presented.settle();
    counts_.targets.settle();
    publish_counts();
  }
  (void)writer_.finish(gone ? "ended" : "finished", gone ? "the program ended without exit()" : "");
  counts_.presented.show_in(nullptr);
  counts_.targets.show_in(nullptr);
  live_.close();
  live_picture_.close();
}

void CaptureWorker::presented() {
  if (!opened_ && alive()) {
    constexpr uint64_t kPatience = 2'000'000'000;
    const uint64_t end_ns = now_ns() + kPatience;
    std::unique_lock lock(opened_mutex_);
    while (!opened_ && alive() && !ended_ && now_ns() < end_ns) opened_changed_.wait(lock, kPatience / 20);
  }
  if (ended_) count_after_end();
}

void CaptureWorker::count_after_end() {
  const std::lock_guard lock(finish_mutex_);
  try {
    take(nullptr);
    end_run();
  } catch (const std::exception& error) {
    give_up(error.what());
  }
}

Result<void> CaptureWorker::create_directory() {
  const auto folder = make_run_folder(options_.output, info_.program + "-" + std::to_string(info_.pid));
  if (!folder) return folder.error();
  const std::string& path = *folder;
  write_session_mark(path, info_.pid);
  if (auto made = writer_.create(path, info_, options_); !made) return made;
  if (auto made = presents_.create(path + "/presents.csv", kPresentColumns); !made) return made;
  if (auto made = surface_rows_.create(path + "/surfaces.csv", kSurfaceColumns); !made) return made;
  pictures_.open(path, options_);
  live_.open(path, info_, options_);
  if (LivePage* page = live_.page()) {
    counts_.presented.show_in(&page->presented);
    counts_.targets.show_in(&page->targets);
  }
  log_.write(LogLevel::kInfo, path + ": run started");
  return {};
}

CaptureWorker::Surface* CaptureWorker::known_surface(const CapturedFrame& frame) {
  const auto found = surfaces_.find(frame.window);
  return found != surfaces_.end() && found->second.number == frame.surface ? &found->second : nullptr;
}

void CaptureWorker::process(const CapturedFrame& frame) {
  Surface* surface = known_surface(frame);
  // Memory is had for the first frame of a surface: always on one thread, or it would come from two heaps.
  const bool may_yield = options_.on_full == OnFull::kBlock && surface != nullptr;
  if (surface == nullptr) {
    if (const auto written = append_surface(frame); !written) return give_up(written.error().text);
    surface = &surfaces_
                   .insert_or_assign(frame.window,
                                     Surface{frame.surface, SurfaceEngine(options_.schemes, options_.model)})
                   .first->second;
  }
  statistics_.frame = frame.frame;
  statistics_.surface = frame.surface;
  statistics_.time_ns = frame.time_ns;
  statistics_.readback_ns = frame.readback_ns;
  BlockBits* bits = pictures_.bits_for(frame.frame);
  const bool watched = frame.role == SurfaceRole::kPresented && live_.picture_wanted();
  if (watched && bits == nullptr) bits = &watched_bits_;
  surface->engine.note_block_bits(bits);
  surface->engine.begin(frame.view, statistics_);
  compress(surface->engine, may_yield);
  if (const auto written = pictures_.write(statistics_, frame.view); !written)
    return give_up(written.error().text);
  dump_frame(frame, log_);
  if (const auto written = append_present(frame); !written) return give_up(written.error().text);
  if (const auto written = writer_.append(statistics_); !written) return give_up(written.error().text);
  counts_.of(frame.role).raise(&LiveCounts::captured);
  // Without the frame in hand: it is pending until the queue has it back.
  if (frame.role == SurfaceRole::kPresented)
    live_.update(statistics_, writer_.totals(), counts_.presented.now(), queue_.pending() - 1,
                 queue_.depth());
  if (watched)
    live_.set_picture_error(
        live_picture_.write(writer_.path(), live_.state(), frame.view, *bits, options_.model.burst_bits));
}

void CaptureWorker::compress(SurfaceEngine& engine, bool may_yield) {
  // A program that ends waits for all that is pending, and so does a replay behind the last frame wanted.
  const std::optional<uint64_t> last = options_.frames.last();
  const auto awaited = [&] { return queue_.closed() || (last && counts_.presented.seen() > *last); };
  const auto yields = [&] { return !awaited() && pace_.yields(queue_.pending(), queue_.depth()); };
  bool more = true;
  if (may_yield && yields()) {
    // When frames pile up before this one is done, the rest of it is done at full priority.
    const YieldingThread::Turn turn = yielding_.run([&] {
      while (more && yields()) more = engine.advance();
    });
    pace_.yielded(turn.wall_ns, turn.cpu_ns, queue_.full());
  } else {
    pace_.hurried();
  }
  while (more) {
    more = engine.advance();
    task_.note_progress();
  }
}

Result<void> CaptureWorker::append_present(const CapturedFrame& frame) {
  std::string row;
  for (const uint64_t value :
       {frame.frame, uint64_t{frame.surface}, frame.readback_ns, frame.read_ns, frame.wait_ns})
    row += std::to_string(value) + ",";
  row += frame.damage;
  for (const uint64_t value : {frame.bind_ns, frame.hand_off_ns, frame.interval_ns})
    (row += ',') += std::to_string(value);
  return presents_.append(row.append(",").append(frame.cause).append(",").append(name_of(frame.way)) + "\n");
}

Result<void> CaptureWorker::append_surface(const CapturedFrame& frame) {
  const bool target = frame.role == SurfaceRole::kTarget;
  return surface_rows_.append(
      std::to_string(frame.surface) + (target ? ",target," : ",presented,") + frame.origin + "," +
      std::to_string(frame.view.width) + "," + std::to_string(frame.view.height) + "," +
      std::string(traits(frame.view.format).name) + (frame.srgb ? ",srgb\n" : ",linear\n"));
}

void CaptureWorker::publish_counts() {
  writer_.set_counts(counts_.presented.now(), counts_.targets.now());
  constexpr uint32_t kEveryRoad = (1u << TILEPRESS_ROAD_COUNT) - 1;
  if (counts_.roads == kEveryRoad && info_.via != "preload+glvnd") {
    info_.via = "preload+glvnd";
    writer_.set_info(info_);
  }
}

void CaptureWorker::give_up(const std::string& reason) {
  log_.write(LogLevel::kError, reason.empty() ? "run folder: cannot be written" : reason);
  if (writer_.is_open()) {
    publish_counts();
    (void)writer_.finish("failed", reason);
    live_.close();
    live_picture_.close();
  }
  alive_ = false;
  while (!queue_.close()) {
  }
}

void CaptureWorker::finish() {
  // Bounded at every step: the caller may be a signal handler on top of any thread of the program.
  if (ended_ || !queue_.close()) return;
  if (!finish_mutex_.try_lock()) return;
  thread_.join();
  ended_ = true;
  finish_mutex_.unlock();
}

}  // namespace tilepress
