// Study tables: writes the tables of a study from its results.
#pragma once

#include "study/study_plan.h"

namespace tilepress {

/// Writes results.csv, means.csv, the tables of workloads, study.json and provenance.json into the study folder.
Result<void> write_study_tables(const StudyPlan& plan, const StudyOptions& options);

}  // namespace tilepress
