// Replay batch: one thread reads traces, the others each wait for a retracer.
#include "tilepress/replay_batch.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>

namespace tilepress {
namespace {

constexpr std::chrono::milliseconds kTickPeriod{100};

/// A queue of prepared replays, from the thread that reads traces to the threads that replay them.
class ReadyReplays {
 public:
  void add(TraceReplay* replay) {
    const std::lock_guard lock(mutex_);
    replays_.push_back(replay);
    changed_.notify_one();
  }
  /// No replay is added after this.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }
  /// Waits for the next replay. Returns null if none is left, or once `stop` is set.
  TraceReplay* next(const std::atomic<int>& stop) {
    std::unique_lock lock(mutex_);
    while (next_ == replays_.size() && !closed_ && !stop) changed_.wait_for(lock, kTickPeriod);
    return next_ == replays_.size() || stop ? nullptr : replays_[next_++];
  }
  size_t count() {
    const std::lock_guard lock(mutex_);
    return replays_.size();
  }
  BatchProgress progress() {
    const std::lock_guard lock(mutex_);
    BatchProgress progress;
    if (closed_) progress.frames_wanted = 0;
    for (const TraceReplay* replay : replays_) {
      progress.frames_done += replay->frames_done();
      const std::optional<uint64_t> wanted = replay->frames_wanted();
      if (!wanted) progress.frames_wanted.reset();
      if (progress.frames_wanted) *progress.frames_wanted += *wanted;
    }
    return progress;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<TraceReplay*> replays_;
  size_t next_ = 0;
  bool closed_ = false;
};

}  // namespace

ReplayBatch::ReplayBatch(const std::vector<ReplayInput>& inputs, const ReplayOptions& options) {
  for (const ReplayInput& input : inputs) replays_.push_back(std::make_unique<TraceReplay>(input, options));
}

void ReplayBatch::run(unsigned jobs, const std::atomic<int>& stop,
                      const std::function<void(const BatchProgress&)>& tick) {
  jobs = std::max(jobs, 1u);
  ReadyReplays ready;
  std::vector<std::future<void>> tasks;
  tasks.push_back(std::async(std::launch::async, [&] {
    for (const auto& replay : replays_) {
      if (stop) break;
      const bool at_once = ready.count() < jobs;
      if (replay->prepare(at_once ? TraceReading::kMeanwhile : TraceReading::kBefore))
        ready.add(replay.get());
    }
    ready.close();
  }));
  for (size_t i = std::min<size_t>(jobs, replays_.size()); i > 0; --i)
    tasks.push_back(std::async(std::launch::async, [&] {
      while (TraceReplay* replay = ready.next(stop)) replay->run(stop);
    }));
  for (auto& task : tasks) {
    while (task.wait_for(kTickPeriod) != std::future_status::ready) tick(ready.progress());
    task.get();
  }
  tick(ready.progress());
}

}  // namespace tilepress
