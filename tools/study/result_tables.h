// Result tables: results.csv and means.csv.
#pragma once

#include <string>
#include <vector>

#include "study/study_results.h"

namespace tilepress {

/// A row per workload and configuration that has a result, in the order of the inputs and of the study.
std::string results_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);

/// A row per category and configuration, over the workloads that have a result: harmonic means of rates,
/// arithmetic means of coverages, minimum, median and maximum. The category "all" comes last.
std::string means_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);

}  // namespace tilepress
