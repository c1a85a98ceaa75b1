// Capture worker: compresses captured frames and writes the run, in a task that outlives the program.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "interposer/engine/shim_log.h"
#include "interposer/engine/worker/capture_counts.h"
#include "interposer/engine/worker/frame_queue.h"
#include "interposer/engine/worker/own_thread.h"
#include "interposer/engine/worker/plain_lock.h"
#include "interposer/engine/worker/run_tables.h"
#include "interposer/engine/worker/surviving_task.h"
#include "interposer/engine/worker/yielding_thread.h"
#include "tilepress/block_log.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/frame_pictures.h"
#include "tilepress/live_page.h"
#include "tilepress/live_picture.h"
#include "tilepress/result.h"
#include "tilepress/run_directory.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

/// Owns the run directory, and creates it at the first present. A process that presents nothing leaves no
/// trace.
class CaptureWorker {
 public:
  CaptureWorker(const RunOptions& options, const RunInfo& info, CaptureCounts& counts, ShimLog& log);
  /// Starts the thread, with all signals blocked. Returns false if the system has no thread left.
  bool start();
  FrameQueue& queue() { return queue_; }
  /// Writes out all pending frames, and ends the run and the thread. Does nothing if that is not safe.
  void finish();
  /// True after finish(). Frames that are presented later are counted and not read: Mesa frees tables in an
  /// exit handler of its own, and its glReadPixels would read what is freed.
  bool ended() const { return ended_; }
  /// Call it after each present. After the first one it waits for the run folder, so that the run outlives
  /// the program from then on. After finish() it writes the counts.
  void presented();
  /// False once the run cannot be written (full disk, unwritable folder).
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
  Result<void> process(const CapturedFrame& frame);
  /// Compresses the rest of a frame that has begun.
  void compress(SurfaceEngine& engine, bool may_yield);
  void publish_counts();
  void give_up(const std::string& reason);

  const RunOptions options_;
  RunInfo info_;
  CaptureCounts& counts_;
  ShimLog& log_;
  FrameQueue queue_;
  RunWriter writer_;
  RunTables tables_;
  FramePictures pictures_;
  LiveWriter live_;
  LivePictureWriter live_picture_;
  BlockLog block_log_;
  BlockBits block_bits_;                  ///< for live_picture_ and block_log_, if no heat map is due
  std::vector<CompressedSurface> stored_;  ///< one per scheme if block_log_ wants data
  std::map<uint32_t, Surface> surfaces_;  ///< by window
  FrameStatistics statistics_;
  WorkerPace pace_;
  YieldingThread yielding_;
  SurvivingTask task_;
  OwnThread thread_;
  PlainMutex finish_mutex_;
  PlainMutex opened_mutex_;
  PlainCondition opened_changed_;
  std::atomic<bool> opened_{false};  ///< the run folder exists, or creating it has failed
  std::atomic<bool> ended_{false};   ///< finish() has joined the thread
  std::atomic<bool> alive_{true};
};

}  // namespace tilepress
