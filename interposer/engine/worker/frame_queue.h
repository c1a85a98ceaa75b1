// Frame queue: hands captured frames from the program's threads to the worker, a bounded number at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>

#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/worker/plain_lock.h"

namespace tilepress {

/// The bound counts frames the worker has not finished, not those being filled: a program whose threads wait
/// for each other's presents cannot be held up by a frame that none of them can finish.
class FrameQueue {
 public:
  /// `program_gone`: for a worker that outlives the program. True once no other thread uses the queue.
  explicit FrameQueue(uint32_t depth, std::function<bool()> program_gone = {})
      : depth_(depth), program_gone_(std::move(program_gone)) {}
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;
  ~FrameQueue();

  /// A frame to fill. When `depth` frames are pending: waits if `wait`, else returns null. Null also after
  /// close().
  CapturedFrame* acquire(bool wait);
  void submit(CapturedFrame* frame);    ///< presented, and filled or awaited
  void submit_end_of(uint32_t window);  ///< the window presents no more; never waits
  void release(CapturedFrame* frame);   ///< back unused, or done with
  void wake();                          ///< makes next() return
  /// The pixels of an awaited frame are there, or will never be. It may be submitted or released before or
  /// after.
  void arrived(CapturedFrame* frame, bool whole);

  /// The worker's side: the next frame, or null after wake() or once closed and empty. Waits for one that is
  /// awaited; once closed for two seconds, then it is lost. Closes the queue when the program is gone: what
  /// is awaited is lost then.
  CapturedFrame* next();
  void done(CapturedFrame* frame);

  /// No more frames; what is pending is still handed out. Gives up, returning false, if the lock cannot be
  /// had within a second: the caller may be a signal handler on top of a thread that holds it.
  bool close();
  bool closed_and_empty();
  bool closed() const { return closed_; }
  uint32_t depth() const { return depth_; }
  /// Frames submitted that the worker has not finished. Takes no lock: a thread that yields to all others
  /// must not hold one that they wait for.
  uint32_t pending() const { return pending_; }
  /// As many as the bound: who acquires a frame now has to wait, or gets none.
  bool full() const { return pending() >= depth_; }

 private:
  /// Frames in a row. A thread that is gone may have stopped at any line: the list is whole all the same.
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
  bool abandoned_ = false;  ///< by the program
};

}  // namespace tilepress
