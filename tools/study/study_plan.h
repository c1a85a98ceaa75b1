// Study plan: the tasks of a study. Every process that works on a study makes the same list.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/inputs.h"
#include "study/study_file.h"
#include "study/study_options.h"

namespace tilepress {

/// A workload with some configurations, or with the bounds.
struct StudyTask {
  std::string id;  ///< names files; unique in the study
  size_t workload = 0;
  std::vector<size_t> configurations;  ///< positions in StudyFile::configurations; empty: the bounds
  uint32_t burst_bits = 0;             ///< a further burst of the study; 0: the burst of the options
  bool is_bounds() const { return configurations.empty(); }
};
/// The options under which a task models: its own burst, if it has one.
RunOptions run_options_of(const StudyTask& task, const StudyOptions& options);
/// The bursts of the study that the options do not have.
std::vector<uint32_t> further_bursts(const StudyFile& study, const StudyOptions& options);
/// What a task computes: "3 configurations", "5 bounds".
std::string task_content(const StudyTask& task);
/// Results of the task: a workload and a configuration, or a workload and a bound.
size_t result_count(const StudyTask& task);

/// Cuts the configurations into chunks of about `chunk`. Configurations whose keys have equal values share
/// tables in the model and stay together.
std::vector<std::vector<size_t>> chunk_configurations(const std::vector<SchemeSpec>& configurations,
                                                      size_t chunk);

/// One task per workload and chunk, workload by workload; then the same for each further burst, and one for the
/// bounds if the options have them. A finished run has one task only.
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
