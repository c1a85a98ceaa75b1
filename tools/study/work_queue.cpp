// Work queue: one lock, one condition.
#include "work_queue.h"

#include <algorithm>

namespace tilepress {

std::optional<StudyWork> WorkQueue::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return can_prepare() || !tasks_.empty() || preparing_ == 0; });
  if (can_prepare()) {
    ++preparing_;
    return StudyWork{.workload = workloads_[next_++]};
  }
  const auto pixels = [](const StudyWork& work) { return work.prepared->pixels; };
  const auto largest = std::ranges::max_element(tasks_, {}, pixels);
  if (largest == tasks_.end()) return std::nullopt;
  const StudyWork work = *largest;
  tasks_.erase(largest);
  changed_.notify_all();  // another workload may be prepared now
  return work;
}

void WorkQueue::prepared(const std::vector<const StudyTask*>& tasks, const PreparedWorkload* workload) {
  const std::lock_guard lock(mutex_);
  --preparing_;
  for (const StudyTask* task : tasks) tasks_.push_back({task->workload, task, workload});
  changed_.notify_all();
}

void WorkQueue::stop() {
  const std::lock_guard lock(mutex_);
  next_ = workloads_.size();
  tasks_.clear();
  changed_.notify_all();
}

}  // namespace tilepress
