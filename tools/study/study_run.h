// Study run: prepares workloads and runs tasks, on threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "study/study_task.h"

namespace tilepress {

struct StudyCounts {
  uint64_t rendered = 0, from_cache = 0;  ///< traces
  uint64_t computed = 0, kept = 0;        ///< results: a workload and a configuration
  uint64_t failed = 0;                    ///< workloads without frames, and tasks that failed
  uint64_t elsewhere = 0;                 ///< tasks that another process works on
  bool interrupted = false;
};

/// Frames modelled or rendered so far, and all frames unless they are not known. May be null, which saves the
/// counting.
using StudyProgress = std::function<void(uint64_t, std::optional<uint64_t>)>;

/// Runs the tasks of the shard. Each of `options.jobs` threads renders or models, whatever the queue has next.
/// Says one line for each workload or task that fails; the others go on. Calls `progress` about ten times a
/// second from this thread.
StudyCounts run_study(const StudyPlan& plan, const StudyOptions& options, const std::atomic<int>& stop,
                      const StudyProgress& progress);

}  // namespace tilepress
