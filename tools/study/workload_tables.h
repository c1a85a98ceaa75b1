// Workload tables: workloads.csv, frame_metrics.csv, color_cdf.csv and frame_rates.csv.
#pragma once

#include <string>
#include <vector>

#include "study/study_results.h"

namespace tilepress {

/// A row per workload, with its state and, of workloads with frames, means over the frames that are not
/// warm-up.
std::string workloads_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
/// The metrics of each frame.
std::string frame_metrics_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
/// The share of pixels that the most frequent colours cover.
std::string color_cdf_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
/// The rates of each frame with the baseline configuration.
std::string frame_rates_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);

}  // namespace tilepress
