// Study tables: the tables of a study from its results, one text per file.
#pragma once

#include <string>
#include <vector>

#include "study/study_results.h"

namespace tilepress {

/// Writes the tables below into the study folder: those of workloads and results always, bounds and
/// sensitivity only if the study has them.
Result<void> write_study_tables(const StudyPlan& plan, const StudyOptions& options);

/// A row per workload and configuration that has a result, in the order of the inputs and of the study.
std::string results_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
/// A row per category and configuration, over the workloads that have a result: harmonic means of rates,
/// arithmetic means of coverages, minimum, median and maximum. The category "all" comes last.
std::string means_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
/// The same two tables of the bounds, with the column "bound" in place of the configuration's.
std::string bounds_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
std::string bound_means_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
/// Means as in means.csv, a row per category, configuration and burst of the study, with the DRAM presets
/// that have the burst.
std::string sensitivity_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);

/// A row per workload, with its state and, of workloads with frames, means over the frames that are not
/// warm-up.
std::string workloads_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
/// The metrics of each frame.
std::string frame_metrics_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
/// The share of pixels that the most frequent colours cover.
std::string color_cdf_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);
/// The rates of each frame with the baseline configuration.
std::string frame_rates_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results);

/// What figures are drawn from beside the tables.
std::string study_json(const StudyPlan& plan, const StudyOptions& options);
/// Where each result comes from: input, frames, renderer, versions, hosts, dates, and the file with its rows.
std::string provenance_json(const StudyPlan& plan, const StudyOptions& options,
                            const std::vector<WorkloadResults>& results);

}  // namespace tilepress
