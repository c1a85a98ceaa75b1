// Study task: models what a task lacks and stores it.
#pragma once

#include <atomic>
#include <cstdint>

#include "study/prepare.h"
#include "study/study_plan.h"

namespace tilepress {

enum class TaskEnd : uint8_t {
  kComputed,
  kKept,         ///< all results were there
  kElsewhere,    ///< another process works on the task
  kInterrupted,  ///< a signal came
  kNoFrames,     ///< the workload has no frames to model: the record says why
};

struct TaskOutcome {
  TaskEnd end = TaskEnd::kKept;
  uint64_t computed = 0, kept = 0;  ///< results
};

/// How many results of the task are not stored.
size_t missing_results(const StudyPlan& plan, const StudyTask& task, const WorkloadRecord& record,
                       const StudyOptions& options);

/// Runs one task and stores its results, each whole or not at all, and its record. Thread-safe. Error: the
/// frames cannot be read or the results not be written; the record then holds the reason.
Result<TaskOutcome> run_task(const StudyPlan& plan, const StudyTask& task, const PreparedWorkload& prepared,
                             const StudyOptions& options, const std::atomic<int>& stop,
                             std::atomic<uint64_t>& frames_done);

}  // namespace tilepress
