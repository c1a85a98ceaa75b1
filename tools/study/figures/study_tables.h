// Study tables: configurations, workloads, system, bounds, hardware cost and energy.
#pragma once

#include <vector>

#include "report/html_text.h"
#include "study/figures/study_data.h"

namespace tilepress {

/// The tables of tables/, in the order of the page:
///   baseline        the settings that hold where no axis varies them, beside the paper's
///   configurations  every configuration with its means
///   bounds          what general compressors reach, by category; only if the study has bounds
///   workloads       every workload, also those without results and why
///   system          categories with their workloads and frames, beside the paper's
///   hardware-cost   area, leakage, access energy, latency, bandwidth and storage of each structure
///   energy          DRAM energy saved per category and scheme
std::vector<Table> study_tables(const StudyData& data);

}  // namespace tilepress
