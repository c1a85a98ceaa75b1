// Frame queue: a free list and a ready list under one lock.
#include "interposer/engine/worker/frame_queue.h"

#include <memory>

#include "interposer/system_calls.h"

namespace tilepress {

constexpr uint64_t kSecond = 1'000'000'000;
constexpr uint64_t kPatience = 2 * kSecond;
constexpr uint64_t kLook = kSecond / 10;  ///< how often the worker checks whether the program is gone

void FrameQueue::List::append(CapturedFrame* frame) {
  frame->next = nullptr;
  (first == nullptr ? first : last->next) = frame;
  last = frame;
}

void FrameQueue::List::prepend(CapturedFrame* frame) {
  frame->next = first;
  if (first == nullptr) last = frame;
  first = frame;
}

CapturedFrame* FrameQueue::List::take_first() {
  CapturedFrame* frame = first;
  if (frame != nullptr) first = frame->next;
  return frame;
}

FrameQueue::~FrameQueue() {
  for (List* list : {&free_, &ready_})
    while (CapturedFrame* frame = list->take_first()) delete frame;
}

CapturedFrame* FrameQueue::acquire(bool wait) {
  Lock lock(mutex_);
  while (wait && pending_ >= depth_ && !closed_) changed_.wait(lock);
  if (pending_ >= depth_ || closed_) return nullptr;
  return any_free();
}

CapturedFrame* FrameQueue::any_free() {
  CapturedFrame* frame = free_.take_first();
  if (frame == nullptr) return std::make_unique<CapturedFrame>().release();
  frame->last_of_window = false;
  frame->lost = false;
  return frame;
}

void FrameQueue::submit_end_of(uint32_t window) {
  {
    const Lock lock(mutex_);
    CapturedFrame* frame = any_free();
    frame->window = window;
    frame->last_of_window = true;
    ready_.append(frame);
    ++pending_;
  }
  changed_.notify_all();
}

void FrameQueue::submit(CapturedFrame* frame) {
  const uint64_t begin_ns = now_ns();
  {
    const Lock lock(mutex_);
    ready_.append(frame);
    ++pending_;
    frame->hand_off_ns = now_ns() - begin_ns;  // under the lock: after it, the worker may have the frame
  }
  changed_.notify_all();
}

void FrameQueue::release(CapturedFrame* frame) {
  const Lock lock(mutex_);
  frame->unwanted = frame->awaited;  // the late reader still writes to it
  if (!frame->unwanted) free_.prepend(frame);
}

void FrameQueue::arrived(CapturedFrame* frame, bool whole) {
  {
    const Lock lock(mutex_);
    frame->awaited = false;
    frame->lost = !whole;
    if (frame->unwanted) free_.prepend(frame);
    frame->unwanted = false;
  }
  changed_.notify_all();
}

void FrameQueue::wake() {
  {
    const Lock lock(mutex_);
    woken_ = true;
  }
  changed_.notify_all();
}

FrameQueue::Lock FrameQueue::lock_of_worker() {
  if (!program_gone_) return Lock(mutex_);
  // A thread that is gone may have held the lock. A thread that is about to go leaves the processor at once.
  while (!mutex_.try_lock_for(kSecond)) {
    if (!program_gone_()) continue;
    mutex_.take_over();
    break;
  }
  return Lock(mutex_, std::adopt_lock);
}

void FrameQueue::lose_front() {
  ready_.first->awaited = false;
  ready_.first->lost = true;
}

CapturedFrame* FrameQueue::next() {
  Lock lock = lock_of_worker();
  uint64_t end_ns = 0;
  while (!front_is_whole()) {
    if (program_gone_ && program_gone_()) {
      closed_ = abandoned_ = true;
      if (ready_.first != nullptr) lose_front();
      break;
    }
    if (closed_) {
      if (ready_.first == nullptr) break;
      const uint64_t now = now_ns();
      if (end_ns == 0) end_ns = now + kPatience;
      if (now >= end_ns) {
        lose_front();
        break;
      }
    } else if (woken_) {
      break;
    }
    const uint32_t turn = changed_.turn();
    lock.unlock();
    changed_.wait_past(turn, kLook);
    lock = lock_of_worker();
  }
  woken_ = false;
  if (!front_is_whole()) return nullptr;
  return ready_.take_first();
}

void FrameQueue::done(CapturedFrame* frame) {
  {
    const Lock lock = lock_of_worker();
    if (!abandoned_) free_.prepend(frame);
    --pending_;
  }
  changed_.notify_all();
}

bool FrameQueue::close() {
  if (!mutex_.try_lock_for(kSecond)) return false;
  closed_ = true;
  mutex_.unlock();
  changed_.notify_all();
  return true;
}

bool FrameQueue::closed_and_empty() {
  const Lock lock = lock_of_worker();
  return closed_ && ready_.first == nullptr;
}

}  // namespace tilepress
