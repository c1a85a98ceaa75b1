// Capture worker: compresses captured frames and writes the run, in a task that outlives the program.
#pragma once

#include <atomic>
#include <map>
#include <string>

#include "interposer/engine/worker/frame_queue.h"
#include "interposer/engine/worker/own_thread.h"
#include "interposer/engine/worker/plain_lock.h"
#include "interposer/engine/shim_log.h"
#include "interposer/engine/worker/surviving_task.h"
#include "interposer/engine/worker/worker_pace.h"
#include "interposer/engine/worker/yielding_thread.h"
#include "interposer/engine_contract.h"
#include "interposer/run/append_file.h"
#include "tilepress/frame_pictures.h"
#include "tilepress/live_page.h"
#include "tilepress/live_picture.h"
#include "tilepress/run_directory.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

/// Counts of the process, raised by the presenting threads (and `captured` by the worker).
class RoleCounts {
 public:
  using Count = std::atomic<uint64_t> LiveCounts::*;
  void raise(Count count, uint64_t by = 1);
  uint64_t of(Count count) const { return counts_.*count; }
  uint64_t seen() const { return counts_.seen; }
  RunCounts now() const;
  /// Shows the counts in `shared` too, from now on; null = no more.
  void show_in(LiveCounts* shared);
  /// Counts what was seen and left no other trace as not captured: the program has ended.
  void settle();

 private:
  LiveCounts counts_{};
  std::atomic<LiveCounts*> shared_{nullptr};
};
struct CaptureCounts {
  RoleCounts presented, targets;
  std::atomic<uint32_t> roads{0};  ///< a bit for each enum TilepressRoad by which frames have come
  RoleCounts& of(SurfaceRole role) { return role == SurfaceRole::kTarget ? targets : presented; }
};

/// Owns the run directory, which it creates at the first present: a process that presents nothing leaves no
/// trace.
class CaptureWorker {
 public:
  CaptureWorker(const RunOptions& options, const RunInfo& info, CaptureCounts& counts, const ShimLog& log);
  /// Starts the thread with all signals blocked. False if the system gives none.
  bool start();
  FrameQueue& queue() { return queue_; }
  /// Writes out all pending frames, ends the run and the thread. Does nothing if that cannot be done safely.
  void finish();
  /// True after finish(). Frames that are presented later are counted and not read: a driver that frees its
  /// tables in exit handlers of its own, as Mesa does, would read what is freed.
  bool ended() const { return ended_; }
  /// To be called after each present: waits for the run folder after the first one, so that the run outlives
  /// the program from then on. After finish() writes the counts.
  void presented();
  /// False once the run cannot be written any more (full disk, unwritable folder).
  bool alive() const { return alive_.load(std::memory_order_relaxed); }

 private:
  struct Surface {
    uint32_t number;
    SurfaceEngine engine;
  };
  void run();
  void work_until_closed();
  void take(CapturedFrame* frame);
  void count_after_end();
  void end_run();
  Result<void> create_directory();
  /// Null before its first frame.
  Surface* known_surface(const CapturedFrame& frame);
  void process(const CapturedFrame& frame);
  /// The rest of a frame that has begun.
  void compress(SurfaceEngine& engine, bool may_yield);
  Result<void> append_present(const CapturedFrame& frame);
  Result<void> append_surface(const CapturedFrame& frame);
  void publish_counts();
  void give_up(const std::string& reason);

  const RunOptions options_;
  RunInfo info_;
  CaptureCounts& counts_;
  const ShimLog& log_;
  FrameQueue queue_;
  RunWriter writer_;
  AppendFile presents_;      ///< presents.csv
  AppendFile surface_rows_;  ///< surfaces.csv
  FramePictures pictures_;
  LiveWriter live_;
  LivePictureWriter live_picture_;
  BlockBits watched_bits_;                ///< for live_picture_, when no heat map is due
  std::map<uint32_t, Surface> surfaces_;  ///< by window
  FrameStatistics statistics_;
  WorkerPace pace_;
  YieldingThread yielding_;
  SurvivingTask task_;
  OwnThread thread_;
  PlainMutex finish_mutex_;
  PlainMutex opened_mutex_;
  PlainCondition opened_changed_;
  std::atomic<bool> opened_{false};  ///< the run folder is there, or will never be
  std::atomic<bool> ended_{false};   ///< finish() has joined the thread
  std::atomic<bool> alive_{true};
};

}  // namespace tilepress
