// Study tables: configurations, workloads, system, hardware cost and energy.
#pragma once

#include <vector>

#include "study/figures/document_table.h"
#include "study/figures/study_data.h"

namespace tilepress {

/// The tables of tables/, in the order of the page.
std::vector<DocumentTable> study_tables(const StudyData& data);

// The tables one by one.

/// The settings that hold where no axis varies them, beside the paper's.
DocumentTable baseline_table(const StudyData& data);
/// Every configuration with its means.
DocumentTable configurations_table(const StudyData& data);
/// What general compressors reach, by category.
DocumentTable bounds_table(const StudyData& data);
/// Every workload, also those without results and why.
DocumentTable workloads_table(const StudyData& data);
/// Categories with their workloads and frames, beside the paper's.
DocumentTable system_table(const StudyData& data);
/// Area, leakage, access energy, latency, bandwidth and storage of each structure.
DocumentTable hardware_table(const StudyData& data);
/// DRAM energy saved per category and scheme.
DocumentTable energy_table(const StudyData& data);

}  // namespace tilepress
