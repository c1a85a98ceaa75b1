// Study JSON: study.json, which figures are drawn from, and provenance.json, which traces each result.
#pragma once

#include <string>
#include <vector>

#include "study/study_results.h"

namespace tilepress {

std::string study_json(const StudyPlan& plan, const StudyOptions& options);

/// Where each result comes from: input, frames, renderer, versions, hosts, dates, and the file with its rows.
std::string provenance_json(const StudyPlan& plan, const StudyOptions& options,
                            const std::vector<WorkloadResults>& results);

}  // namespace tilepress
