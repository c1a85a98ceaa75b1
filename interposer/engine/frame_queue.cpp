// Frame queue: a free list and a ready list under one lock.
#include "interposer/engine/frame_queue.h"

#include <chrono>
#include <utility>

#include "interposer/engine/monotonic_clock.h"

namespace tilepress {
namespace {

constexpr std::chrono::seconds kPatience{2};

}  // namespace

CapturedFrame* FrameQueue::acquire(bool wait) {
  std::unique_lock lock(mutex_);
  if (wait) changed_.wait(lock, [&] { return pending_ < depth_ || closed_; });
  if (pending_ >= depth_ || closed_) return nullptr;
  return any_free().release();
}

std::unique_ptr<CapturedFrame> FrameQueue::any_free() {
  if (free_.empty()) return std::make_unique<CapturedFrame>();
  std::unique_ptr<CapturedFrame> frame = std::move(free_.back());
  free_.pop_back();
  frame->last_of_window = false;
  frame->lost = false;
  return frame;
}

void FrameQueue::submit_end_of(uint32_t window) {
  {
    std::lock_guard lock(mutex_);
    std::unique_ptr<CapturedFrame> frame = any_free();
    frame->window = window;
    frame->last_of_window = true;
    ready_.push_back(std::move(frame));
    ++pending_;
  }
  changed_.notify_all();
}

void FrameQueue::submit(CapturedFrame* frame) {
  const uint64_t begin_ns = now_ns();
  std::lock_guard lock(mutex_);
  ready_.emplace_back(frame);
  ++pending_;
  changed_.notify_all();
  frame->hand_off_ns = now_ns() - begin_ns;  // under the lock: later the worker may have it
}

void FrameQueue::release(CapturedFrame* frame) {
  std::lock_guard lock(mutex_);
  frame->unwanted = frame->awaited;  // the late reader still writes to it
  if (!frame->unwanted) free_.emplace_back(frame);
}

void FrameQueue::arrived(CapturedFrame* frame, bool whole) {
  {
    std::lock_guard lock(mutex_);
    frame->awaited = false;
    frame->lost = !whole;
    if (frame->unwanted) free_.emplace_back(frame);
    frame->unwanted = false;
  }
  changed_.notify_all();
}

void FrameQueue::wake() {
  {
    std::lock_guard lock(mutex_);
    woken_ = true;
  }
  changed_.notify_all();
}

CapturedFrame* FrameQueue::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return front_is_whole() || closed_ || woken_; });
  if (closed_ && !ready_.empty() && !changed_.wait_for(lock, kPatience, [&] { return front_is_whole(); })) {
    ready_.front()->awaited = false;
    ready_.front()->lost = true;
  }
  woken_ = false;
  if (!front_is_whole()) return nullptr;
  CapturedFrame* frame = ready_.front().release();
  ready_.pop_front();
  return frame;
}

void FrameQueue::done(CapturedFrame* frame) {
  {
    std::lock_guard lock(mutex_);
    free_.emplace_back(frame);
    --pending_;
  }
  changed_.notify_all();
}

bool FrameQueue::close() {
  std::unique_lock lock(mutex_, std::chrono::seconds(1));
  if (!lock.owns_lock()) return false;
  closed_ = true;
  lock.unlock();
  changed_.notify_all();
  return true;
}

bool FrameQueue::closed_and_empty() {
  std::lock_guard lock(mutex_);
  return closed_ && ready_.empty();
}

}  // namespace tilepress
