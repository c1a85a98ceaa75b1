// Make plan: the study, its inputs, their categories, and the tasks. A unit of its own: tests of tasks link
// no readers of inputs.
#include <filesystem>

#include "study/study_plan.h"

namespace tilepress {

Result<StudyPlan> make_plan(StudyOptions& options) {
  auto study = load_study(options.study);
  if (!study) return study.error();
  StudyPlan plan{std::move(*study), {}, {}, {}};
  if (options.inputs.empty()) options.inputs = plan.study.inputs;
  if (options.inputs.empty()) return Error{ErrorKind::kBadValue, "no input given (see tilepress study --help)"};
  FoundWorkloads found = find_workloads(options.inputs, options.trace_folder);
  for (std::string& input : options.inputs) input = std::filesystem::absolute(input).lexically_normal().string();
  plan.workloads = std::move(found.list);
  plan.faults = std::move(found.faults);
  apply_categories(options.categories, plan.study, plan.workloads);
  plan.tasks = plan_tasks(plan.study, plan.workloads, options);
  return plan;
}

}  // namespace tilepress
