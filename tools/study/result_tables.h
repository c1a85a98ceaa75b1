// Result tables: results.csv and means.csv, bounds.csv and bound_means.csv, sensitivity.csv.
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

/// The same two tables of the bounds, with the column "bound" in place of the configuration's.
std::string bounds_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
std::string bound_means_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);

/// Means as in means.csv, a row per category, configuration and burst of the study, with the DRAM presets that have
/// the burst. Header only if the study has no bursts.
std::string sensitivity_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);

}  // namespace tilepress
