// Task status: how far each task of a study is, as the study folder says.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/study_plan.h"

namespace tilepress {

enum class TaskState : uint8_t { kDone, kRunning, kFailed, kNeverRun };

struct TaskStatus {
  const StudyTask* task;
  TaskState state = TaskState::kNeverRun;
  std::string note;  ///< who runs it, or why it failed
};

/// In the order of the plan, which must outlive the result.
std::vector<TaskStatus> task_statuses(const StudyPlan& plan, const StudyOptions& options);

/// A line of counts, and a line per task that runs, failed or never ran.
std::string status_text(const StudyPlan& plan, const std::vector<TaskStatus>& statuses);

}  // namespace tilepress
