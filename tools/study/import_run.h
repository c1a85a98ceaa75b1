// Import run: the rows of a finished run as results of a study.
#pragma once

#include "study/inputs.h"
#include "study/study_file.h"
#include "study/study_options.h"
#include "study/study_records.h"

namespace tilepress {

/// Copies the rows of every configuration of the study that the run has into the result store, and the rows of
/// its frames. Runs of older versions lack columns; their rows stay as they are. `record` becomes "partial" if
/// the run lacks configurations or frames. Error: the run cannot be read, or was made with another tile or
/// burst.
Result<void> import_run(const Workload& workload, const StudyFile& study, const StudyOptions& options,
                        WorkloadRecord& record);

}  // namespace tilepress
