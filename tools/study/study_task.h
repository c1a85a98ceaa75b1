// Study task: models what a task lacks and stores it.
#pragma once

#include <atomic>
#include <cstdint>

#include "study/prepare.h"
#include "study/study_plan.h"

namespace tilepress {

struct TaskOutcome {
  uint64_t computed = 0, kept = 0;  ///< results
  bool elsewhere = false;           ///< another process works on the task
};

/// How many results of the task are not stored.
size_t missing_results(const StudyPlan& plan, const StudyTask& task, const WorkloadRecord& record,
                       const StudyOptions& options);

/// Runs one task and stores its results, each whole or not at all, and its record. Without frames, and after
/// a signal, nothing is computed. Thread-safe. Error: the frames cannot be read or the results not be
/// written; the record then holds the reason.
Result<TaskOutcome> run_task(const StudyPlan& plan, const StudyTask& task, const PreparedWorkload& prepared,
                             const StudyOptions& options, const std::atomic<int>& stop,
                             std::atomic<uint64_t>& frames_done);

}  // namespace tilepress
