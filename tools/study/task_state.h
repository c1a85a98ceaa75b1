// Task state: which tasks run, as files that every process on a shared folder sees.
#pragma once

#include <optional>
#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// Held by the process that works on a task. The kernel releases the lock when the process ends, however it
/// ends.
class TaskLock {
 public:
  TaskLock() = default;
  TaskLock(const TaskLock&) = delete;
  TaskLock& operator=(const TaskLock&) = delete;
  ~TaskLock();  ///< removes the file
  /// Returns false if another process, or another thread, works on the task. Error: kFile.
  Result<bool> take(const std::string& folder, const std::string& task);

 private:
  std::string path_;
  int fd_ = -1;
};

/// The name under which a process locks the frames of a workload while it renders them.
std::string rendering_lock(const std::string& workload);

/// A process that began a task.
struct TaskWorker {
  std::string name;    ///< "host, process 123"
  bool alive = false;  ///< false: it ended before the task was done
};
/// Nothing if no process began the task, or the last one ended in order.
std::optional<TaskWorker> worker_of(const std::string& folder, const std::string& task);

/// Forgets that the task failed or was cut off. A process that works on it goes on.
void forget_task(const std::string& folder, const std::string& task);

}  // namespace tilepress
