// Frame queue: a free list and a ready list under one lock.
#include "interposer/engine/frame_queue.h"

#include <chrono>
#include <new>
#include <utility>

namespace tilepress {

std::byte* CapturedFrame::reserve(size_t bytes) {
  if (bytes > capacity_) {
    pixels_.reset(new (std::nothrow) std::byte[bytes]);
    capacity_ = pixels_ ? bytes : 0;
  }
  return pixels_.get();
}

CapturedFrame* FrameQueue::acquire(bool wait) {
  std::unique_lock lock(mutex_);
  if (wait) changed_.wait(lock, [&] { return pending_ < depth_ || closed_; });
  if (pending_ >= depth_ || closed_) return nullptr;
  if (free_.empty()) return new CapturedFrame;
  CapturedFrame* frame = free_.back().release();
  free_.pop_back();
  return frame;
}

void FrameQueue::submit(CapturedFrame* frame) {
  {
    std::lock_guard lock(mutex_);
    ready_.emplace_back(frame);
    ++pending_;
  }
  changed_.notify_all();
}

void FrameQueue::release(CapturedFrame* frame) {
  std::lock_guard lock(mutex_);
  free_.emplace_back(frame);
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
  changed_.wait(lock, [&] { return !ready_.empty() || closed_ || woken_; });
  woken_ = false;
  if (ready_.empty()) return nullptr;
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
