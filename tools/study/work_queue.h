// Work queue: what a worker of a study does next.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "study/study_task.h"

namespace tilepress {

/// Either a workload to prepare or a task to run.
struct StudyWork {
  size_t workload = 0;
  const StudyTask* task = nullptr;             ///< null: prepare the workload
  const PreparedWorkload* prepared = nullptr;  ///< of the task
};

/// Workloads are prepared in the order given, and a few tasks ahead of the workers: the frames of many workloads may not
/// fit into the cache at a time. Of the tasks that wait, the one with the most pixels comes first, so that no
/// long task is left for the end. Thread-safe.
class WorkQueue {
 public:
  /// At most `ahead` tasks wait while another workload is prepared.
  WorkQueue(std::vector<size_t> workloads, size_t ahead) : workloads_(std::move(workloads)), ahead_(ahead) {}

  /// Waits for the next work. Returns nothing if none is left.
  std::optional<StudyWork> next();
  /// Call it once for each workload that next() returned: the tasks that its frames allow, or none.
  void prepared(const std::vector<const StudyTask*>& tasks, const PreparedWorkload* workload);
  /// Drops all that waits.
  void stop();

 private:
  bool can_prepare() const { return next_ < workloads_.size() && tasks_.size() < ahead_; }

  std::mutex mutex_;
  std::condition_variable changed_;
  const std::vector<size_t> workloads_;
  const size_t ahead_;
  size_t next_ = 0, preparing_ = 0;
  std::vector<StudyWork> tasks_;
};

}  // namespace tilepress
