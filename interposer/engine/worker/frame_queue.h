// Frame queue: hands captured frames from the program's threads to the worker.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/worker/plain_lock.h"

namespace tilepress {

/// The bound counts the frames that the worker has not finished, and not those being filled. So a program
/// whose threads wait for each other's presents never waits for a frame that none of them can finish.
class FrameQueue {
 public:
  /// `program_gone` returns true once no thread of the program is left that uses the queue.
  explicit FrameQueue(uint32_t depth, std::function<bool()> program_gone = {})
      : depth_(depth), program_gone_(std::move(program_gone)) {}
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;
  ~FrameQueue();

  /// Returns a frame to fill, or null after close(). If `depth` frames are pending, waits for room, or
  /// returns null without `wait`.
  CapturedFrame* acquire(bool wait);
  void submit(CapturedFrame* frame);    ///< presented, and filled or awaited
  void submit_end_of(uint32_t window);  ///< the window is gone; never waits
  void release(CapturedFrame* frame);   ///< back unused, or done with
  void wake();                          ///< makes next() return
  /// The pixels of an awaited frame have arrived, or are lost. The frame may be submitted or released before
  /// or after.
  void arrived(CapturedFrame* frame, bool whole);

  /// The worker's side. Returns the next frame, or null after wake() or once the queue is closed and empty.
  /// Waits for an awaited frame, but for two seconds at most in a closed queue: then the frame is lost. If
  /// the program is gone, closes the queue, and awaited frames are lost.
  CapturedFrame* next();
  void done(CapturedFrame* frame);

  /// Takes no more frames. next() still returns the pending ones. Returns false if the lock is not free
  /// within a second: the caller may be a signal handler on top of the thread that holds it.
  bool close();
  bool closed_and_empty();
  bool closed() const { return closed_; }
  uint32_t depth() const { return depth_; }
  /// Frames submitted that the worker has not finished. Takes no lock: a thread that yields to all others
  /// must not hold a lock that they wait for.
  uint32_t pending() const { return pending_; }
  /// True if acquire() would wait or return null now.
  bool full() const { return pending() >= depth_; }

 private:
  /// A linked list that stays whole even if a thread ends at any line of its code.
  struct List {
    CapturedFrame* first = nullptr;
    CapturedFrame* last = nullptr;
    void append(CapturedFrame* frame);
    void prepend(CapturedFrame* frame);
    CapturedFrame* take_first();
  };
  using Lock = std::unique_lock<PlainMutex>;
  CapturedFrame* any_free();
  Lock lock_of_worker();
  bool front_is_whole() const { return ready_.first != nullptr && !ready_.first->awaited; }
  void lose_front();

  const uint32_t depth_;
  const std::function<bool()> program_gone_;
  PlainMutex mutex_;
  PlainCondition changed_;
  List free_, ready_;
  std::atomic<uint32_t> pending_ = 0;  ///< changes under the lock
  std::atomic<bool> closed_ = false;   ///< the same
  bool woken_ = false;
  bool abandoned_ = false;  ///< the program is gone
};

}  // namespace tilepress
