// Study plan: the tasks of a study. Every process that works on a study makes the same list.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/inputs.h"
#include "study/study_file.h"
#include "study/study_options.h"

namespace tilepress {

/// A workload and some configurations.
struct StudyTask {
  std::string id;  ///< names files; unique in the study
  size_t workload = 0;
  std::vector<size_t> configurations;  ///< positions in StudyFile::configurations
};

/// Cuts the configurations into chunks of about `chunk`. Configurations whose keys have equal values share
/// tables in the model and stay together.
std::vector<std::vector<size_t>> chunk_configurations(const std::vector<SchemeSpec>& configurations,
                                                      size_t chunk);

/// One task per workload and chunk, workload by workload. A finished run has one task.
std::vector<StudyTask> plan_tasks(const StudyFile& study, const std::vector<Workload>& workloads,
                                  const StudyOptions& options);

/// A study with its inputs.
struct StudyPlan {
  StudyFile study;
  std::vector<Workload> workloads;
  std::vector<StudyTask> tasks;
  std::vector<Error> faults;  ///< inputs that give no workload
};

/// Loads the study and finds its inputs. Makes options.inputs absolute, and takes those of the study if there are
/// none. Error: the study cannot be read, or no input is given.
Result<StudyPlan> make_plan(StudyOptions& options);

}  // namespace tilepress
