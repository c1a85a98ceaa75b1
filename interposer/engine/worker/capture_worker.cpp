// Capture worker: one frame at a time, in the order of presentation.
#include "interposer/engine/worker/capture_worker.h"

#include <sched.h>

#include <optional>

#include "interposer/engine_contract.h"
#include "interposer/run/descriptors.h"
#include "interposer/system_calls.h"
#include "tilepress/run_folder.h"
#include "tilepress/scheme.h"

namespace tilepress {

CaptureWorker::CaptureWorker(const RunOptions& options, const RunInfo& info, CaptureCounts& counts,
                             ShimLog& log)
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
      log_.debug(std::string("frames are compressed on a thread: ") + task_.obstacle());
    work_until_closed();
    ended = true;
  });
  if (ended) return;
  // Nothing takes frames out of the queue any more: no thread of the program may wait for room.
  log_.error("the capture has been killed");
  alive_ = false;
  while (!queue_.close()) {
  }
}

void CaptureWorker::work_until_closed() {
  // A user who lets frames be dropped wants the program never to wait, so the worker must not take its cores
  // either.
  const sched_param none{};
  if (options_.on_full == OnFull::kDrop) sched_setscheduler(0, SCHED_IDLE, &none);
  leave_descriptors_of_program();
  try {
    // The last turn comes after the queue is closed: since the turn before, threads may have counted presents
    // that have no frame.
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
    if (const Result<void> made = create_directory(); !made) give_up(made.error().text);
    opened_ = true;
    opened_changed_.notify_all();
  }
  if (frame != nullptr) {
    if (frame->last_of_window)
      surfaces_.erase(frame->window);
    else if (frame->lost)
      counts_.of(frame->role).raise(&LiveCounts::not_captured);
    else if (const Result<void> done = alive() ? process(*frame) : Result<void>(); !done)
      give_up(done.error().text);
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
  const Result<std::string> folder =
      make_run_folder(options_.output, info_.program + "-" + std::to_string(info_.pid));
  if (!folder) return folder.error();
  const std::string& path = *folder;
  write_session_mark(path, info_.pid);
  if (Result<void> made = writer_.create(path, info_, options_); !made) return made;
  if (Result<void> made = tables_.create(path); !made) return made;
  if (Result<void> made = block_log_.create(path, options_); !made) return made;
  if (block_log_.wants_data()) stored_.resize(options_.schemes.size());
  pictures_.open(path, options_);
  live_.open(path, info_, options_);
  if (LivePage* page = live_.page()) {
    counts_.presented.show_in(&page->presented);
    counts_.targets.show_in(&page->targets);
  }
  log_.info(path + ": run started");
  return {};
}

Result<void> CaptureWorker::process(const CapturedFrame& frame) {
  const auto found = surfaces_.find(frame.window);
  const bool known = found != surfaces_.end() && found->second.number == frame.surface;
  Surface* surface = known ? &found->second : nullptr;
  // The first frame of a surface, and stored surfaces, allocate memory: always on this thread, or it would come
  // from two heaps.
  const bool may_yield = options_.on_full == OnFull::kBlock && surface != nullptr && stored_.empty();
  if (surface == nullptr) {
    if (Result<void> done = tables_.append_surface(frame); !done) return done;
    for (const std::string& line : unsupported_schemes(options_.schemes, frame.view.format))
      log_.warn("surface " + std::to_string(frame.surface) + ": " + line);
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
  if ((watched || block_log_.is_open()) && bits == nullptr) bits = &block_bits_;
  surface->engine.note_block_bits(bits);
  surface->engine.begin(frame.view, statistics_, stored_);
  compress(surface->engine, may_yield);
  if (block_log_.is_open())
    if (Result<void> done = block_log_.append(block_log_.record(statistics_, *bits, stored_)); !done)
      return done;
  if (Result<void> done = pictures_.write(statistics_, frame.view); !done) return done;
  if (Result<void> done = tables_.append_present(frame); !done) return done;
  if (Result<void> done = writer_.append(statistics_); !done) return done;
  counts_.of(frame.role).raise(&LiveCounts::captured);
  // The frame at hand is still pending, and does not count as queued.
  if (frame.role == SurfaceRole::kPresented)
    live_.update(statistics_, writer_.totals(), counts_.presented.now(), queue_.pending() - 1,
                 queue_.depth());
  if (watched)
    live_.set_picture_error(
        live_picture_.write(writer_.path(), live_.state(), frame.view, *bits, options_.model.burst_bits));
  return {};
}

void CaptureWorker::compress(SurfaceEngine& engine, bool may_yield) {
  // A program that ends waits for all pending frames. So does a replay after the last frame it wants.
  const std::optional<uint64_t> last = options_.frames.last();
  const auto awaited = [&] { return queue_.closed() || (last && counts_.presented.seen() > *last); };
  const auto yields = [&] { return !awaited() && pace_.yields(queue_.pending(), queue_.depth()); };
  bool more = true;
  if (may_yield && yields()) {
    // If frames pile up meanwhile, the rest of this one runs at full priority.
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

void CaptureWorker::publish_counts() {
  writer_.set_counts(counts_.presented.now(), counts_.targets.now());
  constexpr uint32_t kEveryRoad = (1u << TILEPRESS_ROAD_COUNT) - 1;
  if (counts_.roads == kEveryRoad && info_.via != "preload+glvnd") {
    info_.via = "preload+glvnd";
    writer_.set_info(info_);
  }
}

void CaptureWorker::give_up(const std::string& reason) {
  log_.error(reason.empty() ? "run folder: cannot be written" : reason);
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
  // Every step ends in bounded time: the caller may be a signal handler on top of any thread of the program.
  if (ended_ || !queue_.close()) return;
  if (!finish_mutex_.try_lock()) return;
  thread_.join();
  ended_ = true;
  finish_mutex_.unlock();
}

}  // namespace tilepress
