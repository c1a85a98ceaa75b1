// Task status: results first, then locks, then records.
#include "task_status.h"

#include <array>

#include <fmt/format.h>

#include "counted.h"
#include "study/study_task.h"
#include "study/task_state.h"

namespace tilepress {
namespace {

constexpr std::array<const char*, 4> kStateNames = {"done", "running", "failed", "never run"};

TaskStatus status_of(const StudyPlan& plan, const StudyTask& task, const StudyOptions& options) {
  const Workload& workload = plan.workloads[task.workload];
  const auto record = load_workload_record(options.folder, workload.name);
  if (record && !record->has_frames()) return {&task, TaskState::kFailed, record->reason};
  if (record && (workload.kind == WorkloadKind::kRun || missing_results(plan, task, *record, options) == 0))
    return {&task, TaskState::kDone, {}};
  const auto worker = worker_of(options.folder, task.id);
  if (worker && worker->alive) return {&task, TaskState::kRunning, worker->name};
  if (worker) return {&task, TaskState::kFailed, "was cut off (" + worker->name + ")"};
  const auto renderer = worker_of(options.folder, rendering_lock(workload.name));
  if (renderer && renderer->alive) return {&task, TaskState::kRunning, "renders its frames: " + renderer->name};
  if (renderer) return {&task, TaskState::kFailed, "its rendering was cut off (" + renderer->name + ")"};
  const auto ended = load_task_record(options.folder, task.id);
  if (ended && !ended->reason.empty()) return {&task, TaskState::kFailed, ended->reason};
  return {&task, TaskState::kNeverRun, {}};
}

}  // namespace

std::vector<TaskStatus> task_statuses(const StudyPlan& plan, const StudyOptions& options) {
  std::vector<TaskStatus> out;
  for (const StudyTask& task : plan.tasks) out.push_back(status_of(plan, task, options));
  return out;
}

std::string status_text(const StudyPlan& plan, const std::vector<TaskStatus>& statuses) {
  std::array<uint64_t, 4> counts{};
  std::string lines;
  for (size_t i = 0; i < statuses.size(); ++i) {
    const TaskStatus& status = statuses[i];
    ++counts[static_cast<size_t>(status.state)];
    if (status.state == TaskState::kDone) continue;
    lines += fmt::format("  {:>4}  {:<9}  {}, {}{}\n", i + 1, kStateNames[static_cast<size_t>(status.state)],
                         plan.workloads[status.task->workload].name, task_content(*status.task),
                         status.note.empty() ? "" : ": " + status.note);
  }
  std::string out = counted(statuses.size(), "task") + ":";
  for (size_t i = 0; i < counts.size(); ++i)
    out += fmt::format("{} {} {}", i == 0 ? "" : ",", counts[i], kStateNames[i]);
  return out + "\n" + lines;
}

}  // namespace tilepress
