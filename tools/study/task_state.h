// Task state: which tasks run and which failed, as files that every process on a shared folder sees.
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

/// "host, process 123", as far as the lock's file says so; nothing if no process works on the task.
std::optional<std::string> worker_of(const std::string& folder, const std::string& task);

/// One try of a task.
struct TaskRecord {
  std::string reason;  ///< why it failed; empty if it is done
  std::string host, version, date;
  double seconds = 0;
  uint64_t frames = 0;  ///< that were modelled
};

/// Stores DIR/tasks/ID.json.
Result<void> store_task_record(const std::string& folder, const std::string& task, const TaskRecord& record);
/// Nothing if the task has not ended yet.
std::optional<TaskRecord> load_task_record(const std::string& folder, const std::string& task);
/// Forgets that the task failed.
void remove_task_record(const std::string& folder, const std::string& task);

}  // namespace tilepress
