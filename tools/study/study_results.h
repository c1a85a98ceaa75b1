// Study results: everything that the tables of a study are made from.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/result_rows.h"
#include "study/study_plan.h"
#include "study/study_records.h"

namespace tilepress {

struct WorkloadResults {
  WorkloadRecord record;                ///< state "missing" if no process has prepared the workload
  std::vector<FrameStatistics> frames;  ///< without schemes and targets
  std::string colors;                   ///< CSV: colors, pixels_share
  std::vector<std::optional<ResultSums>> sums;  ///< by position in StudyFile::configurations
  std::map<uint32_t, std::vector<std::optional<ResultSums>>> at_bursts;  ///< `sums` at further_bursts()
  std::vector<std::optional<ResultSums>>
      bounds;  ///< by position in bound_names(); none without StudyOptions::bounds
};

/// Loads what the study folder holds for the plan, in the order of its workloads. A result that is not there is
/// left out; the record becomes "partial" with the reason. Error: a file that is there cannot be read.
Result<std::vector<WorkloadResults>> load_study_results(const StudyPlan& plan, const StudyOptions& options);

}  // namespace tilepress
