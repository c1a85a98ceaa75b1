// Study run: workers that prepare and model, and the thread that reports progress.
#include "study_run.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "streams/messages.h"
#include "study/task_state.h"
#include "study/work_queue.h"
#include "study/workload_size.h"

namespace tilepress {
namespace {

constexpr std::chrono::milliseconds kTickPeriod{100};
constexpr size_t kTasksAheadOfWorker = 2;

class StudyWorkers {
 public:
  StudyWorkers(const StudyPlan& plan, const StudyOptions& options, const std::atomic<int>& stop)
      : plan_(plan),
        options_(options),
        stop_(stop),
        queue_(workloads_of_shard(), kTasksAheadOfWorker * options.jobs),
        rendered_(plan.workloads.size()),
        modelled_(plan.tasks.size()) {}

  StudyCounts run(const StudyProgress& progress) {
    running_ = std::max(1u, options_.jobs);
    std::vector<std::jthread> threads;
    for (uint32_t i = 0; i < std::max(1u, options_.jobs); ++i) threads.emplace_back([this] { work(); });
    if (progress) {
      const std::optional<uint64_t> total = all_frames();
      while (running_ > 0) {
        std::this_thread::sleep_for(kTickPeriod);
        const uint64_t done = frames_done();
        progress(done, total && *total >= done ? total : std::nullopt);
      }
    }
    threads.clear();
    counts_.interrupted = stop_ != 0;
    return counts_;
  }

 private:
  std::vector<const StudyTask*> tasks_of(size_t workload) const {
    std::vector<const StudyTask*> tasks;
    for (size_t i = 0; i < plan_.tasks.size(); ++i)
      if (plan_.tasks[i].workload == workload && options_.shard.takes(i)) tasks.push_back(&plan_.tasks[i]);
    return tasks;
  }

  /// The largest traces first, so that no long task is left for the end.
  std::vector<size_t> workloads_of_shard() const {
    std::vector<size_t> workloads;
    for (size_t i = 0; i < plan_.workloads.size(); ++i)
      if (!tasks_of(i).empty()) workloads.push_back(i);
    const auto bytes = [this](size_t workload) -> uintmax_t {
      std::error_code code;
      const Workload& each = plan_.workloads[workload];
      const uintmax_t size = each.kind == WorkloadKind::kTrace ? std::filesystem::file_size(each.paths[0], code) : 0;
      return code ? 0 : size;
    };
    std::ranges::stable_sort(workloads, std::greater<>(), bytes);
    return workloads;
  }

  /// Frames to render and to model. Nothing if the frames of an input are not known before it is read.
  std::optional<uint64_t> all_frames() const {
    uint64_t all = 0;
    for (const size_t i : workloads_of_shard()) {
      const Workload& workload = plan_.workloads[i];
      if (workload.kind == WorkloadKind::kRun) continue;
      const WorkloadSize size = size_of_workload(workload, options_.render);
      if (size.frames == 0) return std::nullopt;
      all += size.frames * (tasks_of(i).size() + size.to_render);
    }
    return all;
  }

  uint64_t frames_done() const {
    uint64_t done = 0;
    for (const auto& frames : rendered_) done += frames;
    for (const auto& frames : modelled_) done += frames;
    return done;
  }

  void work() {
    while (const auto work = queue_.next()) {
      if (stop_ != 0) queue_.stop();
      if (work->task == nullptr) {
        const PreparedWorkload* prepared = prepare(work->workload);
        queue_.prepared(prepared == nullptr ? std::vector<const StudyTask*>() : tasks_of(work->workload), prepared);
      } else if (stop_ == 0) {
        run(*work->task, *work->prepared);
      }
    }
    --running_;
  }

  /// Null if there is nothing to model.
  const PreparedWorkload* prepare(size_t at) {
    const Workload& workload = plan_.workloads[at];
    StudyOptions options = options_;
    options.render.progress = [this, at](uint64_t frames, std::optional<uint64_t>) { rendered_[at] = frames; };
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

  void run(const StudyTask& task, const PreparedWorkload& prepared) {
    std::atomic<uint64_t>& frames = modelled_[static_cast<size_t>(&task - plan_.tasks.data())];
    const auto outcome = run_task(plan_, task, prepared, options_, stop_, frames);
    frames = prepared.record.frames;  // those that were kept or left out, too
    const std::lock_guard lock(mutex_);
    take(task, outcome);
  }

  void take(const StudyTask& task, const Result<TaskOutcome>& outcome) {
    if (!outcome) {
      fail(1, outcome.error());
      ++counts_.failed;
      return;
    }
    counts_.computed += outcome->computed;
    counts_.kept += outcome->kept;
    counts_.elsewhere += outcome->elsewhere;
    if (outcome->computed > 0)
      say(MessageLevel::kInfo,
          fmt::format("{}: {} of {} modelled", plan_.workloads[task.workload].name, outcome->computed,
                      task_content(task)));
  }

  const StudyPlan& plan_;
  const StudyOptions& options_;
  const std::atomic<int>& stop_;
  WorkQueue queue_;
  std::vector<std::atomic<uint64_t>> rendered_;  ///< frames by workload
  std::vector<std::atomic<uint64_t>> modelled_;  ///< frames by task
  std::mutex mutex_;
  std::deque<PreparedWorkload> prepared_;  ///< elements stay where they are
  StudyCounts counts_;
  std::atomic<uint32_t> running_{0};
};

}  // namespace

StudyCounts run_study(const StudyPlan& plan, const StudyOptions& options, const std::atomic<int>& stop,
                      const StudyProgress& progress) {
  return StudyWorkers(plan, options, stop).run(progress);
}

}  // namespace tilepress
