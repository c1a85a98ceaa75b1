// Late reader: the thread that takes late pixels out of pixel buffers, so that none waits for the program's
// next call.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/worker/own_thread.h"
#include "interposer/engine/readback/pixel_buffers.h"
#include "interposer/engine/worker/plain_lock.h"

namespace tilepress {

/// Works jobs off in order. It is the only thread of ours that calls GL, always in a twin of a private
/// context: without a surface, never in a context of the program. The thread starts with the first try_out;
/// there is none before.
class LateReader {
 public:
  using Work = std::function<void(bool entered)>;

  LateReader();
  /// True if the twin of `buffers` can be made current on the thread: asked once, before it is relied on.
  bool try_out(const std::shared_ptr<PixelBuffers>& buffers);
  /// `work` runs with the twin of `buffers` current, or with false where that is no longer possible.
  void post(std::shared_ptr<PixelBuffers> buffers, Work work);
  /// Has the pixels of a frame that is read late put where its view says, and its `arrive` called.
  void post(CapturedFrame& frame);
  /// Returns when all that was posted is done and the thread has nothing of `display` current; false if that
  /// takes longer than two seconds.
  bool let_go(const void* display);
  /// False once the process has begun to end: nothing new should be read late.
  bool accepts() const { return accepts_.load(std::memory_order_relaxed); }

 private:
  struct Job {
    std::shared_ptr<PixelBuffers> buffers;  ///< null: leave `display`, or any if that is null
    const void* display;
    Work work;
  };
  static constexpr const void* kEveryDisplay = nullptr;
  bool is_of_this_process() const;
  bool start();
  using Lock = std::unique_lock<PlainMutex>;
  /// Owns nothing if the mutex cannot be had within two seconds.
  Lock patient_lock();
  bool append(Job job, uint64_t& number);
  bool wait_for(uint64_t number);
  void run();
  void work_off(Job& job);
  void leave();
  static void at_exit();

  const int pid_;
  PlainMutex mutex_;
  PlainCondition changed_;
  std::deque<Job> jobs_;
  uint64_t posted_ = 0, done_ = 0;
  OwnThread thread_;  ///< has no end
  std::atomic<bool> accepts_{true};
  std::shared_ptr<PixelBuffers> current_;  ///< the thread's own: whose twin is current
};

}  // namespace tilepress
