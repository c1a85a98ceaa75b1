// Slurm: submits the tasks of a study as one array job.
#pragma once

#include <string>
#include <vector>

#include "study/study_plan.h"

namespace tilepress {

/// Writes the script to DIR/slurm/job.sh, submits it for the tasks, and after it a job that merges. Slurm's own
/// variables (SBATCH_PARTITION, SBATCH_TIMELIMIT, …) apply. Returns the number of the array job. Error: sbatch
/// is missing or refuses.
Result<std::string> submit_to_slurm(const StudyPlan& plan, const StudyOptions& options,
                                    const std::vector<size_t>& tasks);

}  // namespace tilepress
