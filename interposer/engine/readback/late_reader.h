// Late reader: the thread that copies late pixels out of pixel buffers, so that none waits for the program's
// next call.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/readback/pixel_buffers.h"
#include "interposer/engine/worker/own_thread.h"
#include "interposer/engine/worker/plain_lock.h"

namespace tilepress {

/// Does jobs in order. It is our only thread that calls GL, always in the twin of a private context, without
/// a surface, and never in a context of the program. The first try_out starts the thread.
class LateReader {
 public:
  using Work = std::function<void(bool entered)>;

  LateReader();
  /// Returns true if the thread can make the twin of `buffers` current. Call it once, before the first post.
  bool try_out(const std::shared_ptr<PixelBuffers>& buffers);
  /// Runs `work` with the twin of `buffers` current. Passes false if that is no longer possible.
  void post(std::shared_ptr<PixelBuffers> buffers, Work work);
  /// Copies the pixels of a late frame to where its view says, and calls its `arrive`.
  void post(CapturedFrame& frame);
  /// Waits until all posted work is done and the thread has nothing of `display` current. Returns false if
  /// that takes longer than two seconds.
  bool let_go(const void* display);
  /// False once the process has begun to end: no new frame should be read late.
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
  /// Gives up after two seconds, and returns a lock that owns nothing.
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
  OwnThread thread_;  ///< never ends
  std::atomic<bool> accepts_{true};
  std::shared_ptr<PixelBuffers> current_;  ///< the group whose twin is current; for the thread alone
};

}  // namespace tilepress
