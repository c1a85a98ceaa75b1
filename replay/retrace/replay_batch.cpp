// Replay batch: one thread reads traces, the others each wait for a retracer.
#include "tilepress/replay_batch.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace tilepress {
namespace {

constexpr std::chrono::milliseconds kTickPeriod{100};

bool is_measured(const ReplayResult& result) {
  return (result.status == ReplayStatus::kDone || result.status == ReplayStatus::kKept) &&
         result.run.measured_frames > 0;
}

/// Sums of 1/rate of one scheme.
struct MeanSums {
  uint64_t traces = 0;
  double inverse = 0, inverse_payload = 0;
};

MeanSums sum_over(const std::vector<std::unique_ptr<TraceReplay>>& replays, const std::string& category,
                  const std::string& scheme) {
  MeanSums sums;
  for (const auto& replay : replays) {
    if (!is_measured(replay->result()) || (!category.empty() && replay->input().category != category))
      continue;
    const RunRecord& run = replay->result().run;
    const auto found = std::find(run.scheme_names.begin(), run.scheme_names.end(), scheme);
    if (found == run.scheme_names.end()) continue;
    const SchemeStatistics& total = run.totals[static_cast<size_t>(found - run.scheme_names.begin())];
    ++sums.traces;
    sums.inverse += 1 / total.rate();
    sums.inverse_payload += 1 / total.rate_payload();
  }
  return sums;
}

/// A queue of prepared replays, from the thread that reads traces to the threads that replay them.
class ReadyReplays {
 public:
  void add(TraceReplay* replay) {
    {
      const std::lock_guard lock(mutex_);
      replays_.push_back(replay);
    }
    changed_.notify_one();
  }
  /// No replay is added after this.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
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

void append_once(std::vector<std::string>& list, const std::string& text) {
  if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

}  // namespace

ReplayBatch::ReplayBatch(const std::vector<ReplayInput>& inputs, const ReplayOptions& options) {
  for (const ReplayInput& input : inputs) replays_.push_back(std::make_unique<TraceReplay>(input, options));
}

void ReplayBatch::run(unsigned jobs, const std::atomic<int>& stop,
                      const std::function<void(const BatchProgress&)>& tick) {
  jobs = std::max(jobs, 1u);
  ReadyReplays ready;
  std::mutex mutex;
  std::condition_variable ended;
  size_t working = std::min<size_t>(jobs, replays_.size());  // guarded by mutex
  std::vector<std::thread> threads;
  threads.emplace_back([&] {
    for (const auto& replay : replays_) {
      if (stop) break;
      const bool at_once = ready.count() < jobs;
      if (replay->prepare(at_once ? TraceReading::kMeanwhile : TraceReading::kBefore))
        ready.add(replay.get());
    }
    ready.close();
  });
  for (size_t i = working; i > 0; --i)
    threads.emplace_back([&] {
      for (TraceReplay* replay = ready.next(stop); replay != nullptr; replay = ready.next(stop))
        replay->run(stop);
      {
        const std::lock_guard lock(mutex);
        --working;
      }
      ended.notify_one();
    });
  for (std::unique_lock lock(mutex); !ended.wait_for(lock, kTickPeriod, [&] { return working == 0; });)
    tick(ready.progress());
  for (std::thread& thread : threads) thread.join();
  tick(ready.progress());
}

std::vector<CategoryMean> category_means(const std::vector<std::unique_ptr<TraceReplay>>& replays) {
  std::vector<std::string> categories, schemes;
  for (const auto& replay : replays) {
    if (!is_measured(replay->result())) continue;
    if (!replay->input().category.empty()) append_once(categories, replay->input().category);
    for (const std::string& scheme : replay->result().run.scheme_names) append_once(schemes, scheme);
  }
  categories.emplace_back();
  std::vector<CategoryMean> means;
  for (const std::string& category : categories) {
    for (const std::string& scheme : schemes) {
      const MeanSums sums = sum_over(replays, category, scheme);
      const auto count = static_cast<double>(sums.traces);
      if (sums.traces > 0)
        means.push_back({category, scheme, sums.traces, count / sums.inverse, count / sums.inverse_payload});
    }
  }
  return means;
}

}  // namespace tilepress
