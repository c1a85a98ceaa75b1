// Late reader: callers wait for the thread in bounded time, because it may hang in a driver, or be gone at
// the end of the process.
#include "interposer/engine/readback/late_reader.h"

#include <unistd.h>

#include <cstdlib>
#include <utility>

#include "interposer/engine/own_calls.h"
#include "interposer/system_calls.h"

namespace tilepress {

constexpr uint64_t kPatience = 2'000'000'000;  // ns
static std::atomic<LateReader*> running{nullptr};

LateReader::LateReader() : pid_(getpid()) {}

bool LateReader::is_of_this_process() const {
  return pid_ == getpid();
}

// Drivers end their own threads in exit handlers too. They registered theirs before our first context was
// made, so this handler runs earlier. Frames that are presented afterwards are read synchronously.
void LateReader::at_exit() {
  LateReader* reader = running;
  if (reader == nullptr || !reader->is_of_this_process()) return;
  reader->accepts_ = false;
  reader->let_go(kEveryDisplay);
}

bool LateReader::start() {
  const Lock lock = patient_lock();
  if (!lock.owns_lock()) return false;
  if (thread_.started()) return true;
  if (!thread_.start("tilepress-read", [this] { run(); })) return false;
  static const bool registered = std::atexit(at_exit) == 0;
  running = this;
  return registered;
}

LateReader::Lock LateReader::patient_lock() {
  return mutex_.try_lock_for(kPatience) ? Lock(mutex_, std::adopt_lock) : Lock();
}

bool LateReader::append(Job job, uint64_t& number) {
  {
    const Lock lock = patient_lock();
    if (!lock.owns_lock() || !thread_.started()) return false;
    jobs_.push_back(std::move(job));
    number = ++posted_;
  }
  changed_.notify_all();
  return true;
}

bool LateReader::wait_for(uint64_t number) {
  Lock lock = patient_lock();
  if (!lock.owns_lock()) return false;
  const uint64_t end_ns = now_ns() + kPatience;
  while (done_ < number) {
    const uint64_t now = now_ns();
    if (now >= end_ns) return false;
    changed_.wait(lock, end_ns - now);
  }
  return true;
}

bool LateReader::try_out(const std::shared_ptr<PixelBuffers>& buffers) {
  if (!is_of_this_process() || !accepts() || !start()) return false;
  const auto answer = std::make_shared<std::atomic<bool>>(false);
  uint64_t number = 0;
  return append({buffers, nullptr, [answer](bool entered) { *answer = entered; }}, number) &&
         wait_for(number) && *answer;
}

void LateReader::post(std::shared_ptr<PixelBuffers> buffers, Work work) {
  uint64_t number = 0;
  if (!is_of_this_process() || !append({std::move(buffers), nullptr, work}, number)) work(false);
}

void LateReader::post(CapturedFrame& frame) {
  const std::shared_ptr<LateRead> read = std::move(frame.late);
  std::byte* pixels = frame.reserve(read->bytes);
  frame.awaited = true;
  post(read->buffers, [read, pixels, arrive = frame.arrive](bool entered) {
    arrive(entered && read->buffers->take(*read, pixels));
  });
}

bool LateReader::let_go(const void* display) {
  if (!is_of_this_process()) return true;
  {
    const Lock lock = patient_lock();
    if (lock.owns_lock() && !thread_.started()) return true;
  }
  uint64_t number = 0;
  return append({nullptr, display, nullptr}, number) && wait_for(number);
}

void LateReader::run() {
  inside_engine = true;
  for (;;) {
    Lock lock(mutex_);
    while (jobs_.empty()) changed_.wait(lock);
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    work_off(job);
    job = {};  // frees what the job holds before the job counts as done
    lock.lock();
    ++done_;
    lock.unlock();
    changed_.notify_all();
  }
}

void LateReader::work_off(Job& job) {
  if (job.buffers == nullptr) {
    if (current_ != nullptr && (job.display == kEveryDisplay || current_->display() == job.display)) leave();
    return;
  }
  bool entered = current_ == job.buffers;
  if (!entered) {
    leave();
    entered = job.buffers->twin()->enter();
    if (entered) current_ = job.buffers;
  }
  job.work(entered);
}

void LateReader::leave() {
  if (current_ == nullptr) return;
  current_->twin()->leave();
  current_ = nullptr;
}

}  // namespace tilepress
