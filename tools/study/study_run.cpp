// Study run: a queue of tasks whose frames are ready, between the thread that renders and those that model.
#include "study_run.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "streams/messages.h"
#include "study/task_state.h"

namespace tilepress {
namespace {

constexpr std::chrono::milliseconds kTickPeriod{100};

struct ReadyTask {
  const StudyTask* task;
  const PreparedWorkload* prepared;
};

class TaskQueue {
 public:
  void add(const ReadyTask& task) {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(task);
    changed_.notify_one();
  }
  /// No task is added after this.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }
  /// Waits for the next task. Returns nothing if none is left.
  std::optional<ReadyTask> next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !tasks_.empty(); });
    if (tasks_.empty()) return std::nullopt;
    const ReadyTask task = tasks_.front();
    tasks_.pop_front();
    return task;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<ReadyTask> tasks_;
  bool closed_ = false;
};

class StudyWorkers {
 public:
  StudyWorkers(const StudyPlan& plan, const StudyOptions& options, const std::atomic<int>& stop)
      : plan_(plan), options_(options), stop_(stop) {}

  StudyCounts run(const StudyProgress& progress) {
    running_ = std::max(1u, options_.jobs);
    std::vector<std::jthread> threads;
    threads.emplace_back([this] { prepare_all(); });
    for (uint32_t i = 0; i < std::max(1u, options_.jobs); ++i) threads.emplace_back([this] { work(); });
    while (running_ > 0) {
      std::this_thread::sleep_for(kTickPeriod);
      progress(frames_done_ + frames_rendered_, std::nullopt);
    }
    threads.clear();
    counts_.interrupted = stop_ != 0;
    return counts_;
  }

 private:
  void prepare_all() {
    for (size_t workload = 0; workload < plan_.workloads.size() && stop_ == 0; ++workload) {
      std::vector<const StudyTask*> tasks;
      for (size_t i = 0; i < plan_.tasks.size(); ++i)
        if (plan_.tasks[i].workload == workload && options_.shard.takes(i)) tasks.push_back(&plan_.tasks[i]);
      if (tasks.empty()) continue;
      const PreparedWorkload* prepared = prepare(plan_.workloads[workload]);
      for (const StudyTask* task : tasks)
        if (prepared != nullptr) queue_.add({task, prepared});
    }
    queue_.close();
  }

  /// Null if there is nothing to model.
  const PreparedWorkload* prepare(const Workload& workload) {
    StudyOptions options = options_;
    options.render.progress = [this](uint64_t frames, std::optional<uint64_t>) { frames_rendered_ = frames; };
    PreparedWorkload prepared;
    {
      TaskLock lock;  // for `study status` alone: the frame cache has locks of its own
      if (workload.kind == WorkloadKind::kTrace && !lock.take(options_.folder, rendering_lock(workload.name)))
        say(MessageLevel::kInfo, workload.name + ": `study status` cannot see that it is rendered");
      prepared = prepare_workload(workload, plan_.study, options, stop_);
    }
    if (stop_ != 0) return nullptr;
    const WorkloadRecord& record = prepared.record;
    say_how(workload, prepared);
    const std::lock_guard lock(mutex_);
    if (workload.kind == WorkloadKind::kTrace && record.has_frames())
      ++(prepared.rendered ? counts_.rendered : counts_.from_cache);
    if (const auto stored = store_workload_record(options_.folder, workload.name, record); !stored) {
      fail(1, stored.error());
      ++counts_.failed;
      return nullptr;
    }
    if (!record.has_frames()) ++counts_.failed;
    if (!record.reason.empty()) fail(1, record.source + ": " + record.reason);
    if (!record.has_frames()) return nullptr;
    if (record.state == "partial" && workload.kind != WorkloadKind::kRun) ++counts_.failed;
    prepared_.push_back(std::move(prepared));
    return &prepared_.back();
  }

  static void say_how(const Workload& workload, const PreparedWorkload& prepared) {
    if (workload.kind != WorkloadKind::kTrace || !prepared.record.has_frames()) return;
    say(MessageLevel::kInfo,
        prepared.rendered
            ? fmt::format("{}: rendered {} frames in {:.1f} s", workload.name, prepared.record.frames,
                          prepared.render_seconds)
            : fmt::format("{}: {} frames from the cache", workload.name, prepared.record.frames));
  }

  void work() {
    while (const auto ready = queue_.next()) {
      if (stop_ != 0) continue;  // empties the queue
      const auto outcome = run_task(plan_, *ready->task, *ready->prepared, options_, stop_, frames_done_);
      const std::lock_guard lock(mutex_);
      take(*ready->task, outcome);
    }
    --running_;
  }

  void take(const StudyTask& task, const Result<TaskOutcome>& outcome) {
    if (!outcome) {
      fail(1, outcome.error());
      ++counts_.failed;
      return;
    }
    counts_.computed += outcome->computed;
    counts_.kept += outcome->kept;
    counts_.elsewhere += outcome->end == TaskEnd::kElsewhere;
    if (outcome->computed > 0)
      say(MessageLevel::kInfo, fmt::format("{}: {} configurations modelled", plan_.workloads[task.workload].name,
                                           outcome->computed));
  }

  const StudyPlan& plan_;
  const StudyOptions& options_;
  const std::atomic<int>& stop_;
  TaskQueue queue_;
  std::deque<PreparedWorkload> prepared_;  ///< of prepare_all's thread; elements stay where they are
  std::mutex mutex_;
  StudyCounts counts_;
  std::atomic<uint64_t> frames_done_{0}, frames_rendered_{0};
  std::atomic<uint32_t> running_{0};
};

}  // namespace

StudyCounts run_study(const StudyPlan& plan, const StudyOptions& options, const std::atomic<int>& stop,
                      const StudyProgress& progress) {
  return StudyWorkers(plan, options, stop).run(progress);
}

}  // namespace tilepress
