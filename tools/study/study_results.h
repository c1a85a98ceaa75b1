// Study results: everything that the tables of a study are made from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/result_rows.h"
#include "study/study_plan.h"
#include "study/workload_record.h"

namespace tilepress {

struct WorkloadResults {
  WorkloadRecord record;                ///< state "missing" if no process has prepared the workload
  std::vector<FrameStatistics> frames;  ///< without schemes and targets
  std::string colors;                   ///< CSV: colors, pixels_share
  std::vector<std::optional<ResultSums>> sums;  ///< by position in StudyFile::configurations
};

/// Loads what the study folder holds for the plan, in the order of its workloads. A result that is not there is
/// left out; the record becomes "partial" with the reason. Error: a file that is there cannot be read.
Result<std::vector<WorkloadResults>> load_study_results(const StudyPlan& plan, const StudyOptions& options);

}  // namespace tilepress
