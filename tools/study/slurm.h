// Slurm: submits the tasks of a study as one array job.
#pragma once

#include <string>
#include <vector>

#include "study/study_plan.h"

namespace tilepress {

/// The most elements of an array that Slurm's default configuration takes.
constexpr uint32_t kMostArrayTasks = 1000;

/// Shards that an array job of the plan has: one per task, or fewer, larger ones.
uint32_t array_shards(const StudyPlan& plan);

/// The numbers of the shards that hold any of these tasks, ascending.
std::vector<uint32_t> shards_of(const std::vector<size_t>& tasks, uint32_t shard_count);

/// "1-4,7": the value of sbatch's --array.
std::string array_text(const std::vector<uint32_t>& shards);

/// The script of the array job. An element runs one shard of `shard_count`.
std::string job_script(const StudyPlan& plan, const StudyOptions& options, const std::string& command,
                       uint32_t shard_count);

/// Writes the script to DIR/slurm/job.sh, submits it for the tasks, and after it a job that merges. Slurm's own
/// variables (SBATCH_PARTITION, SBATCH_TIMELIMIT, …) apply. Returns the number of the array job. Error: sbatch
/// is missing or refuses.
Result<std::string> submit_to_slurm(const StudyPlan& plan, const StudyOptions& options,
                                    const std::vector<size_t>& tasks);

}  // namespace tilepress
