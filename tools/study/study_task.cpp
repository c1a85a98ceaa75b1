// Study task: lock, model, store.
#include "study_task.h"

#include <chrono>
#include <filesystem>

#include "streams/messages.h"
#include "study/cache/host_name.h"
#include "study/model_frames.h"
#include "study/result_store.h"
#include "study/task_state.h"
#include "study/text_file.h"

namespace tilepress {
namespace {

bool is_there(const std::string& path) {
  std::error_code code;
  return std::filesystem::exists(path, code);
}

/// The files of a task's workload.
struct TaskFiles {
  ResultStore store;
  std::string workload, digest;
  std::string frames() const { return store.frames_path(workload, digest); }
  std::string colors() const { return store.colors_path(workload, digest); }
  std::string result(const SchemeSpec& spec) const { return store.result_path(workload, digest, spec); }
};

TaskFiles files_of(const StudyPlan& plan, const StudyTask& task, const WorkloadRecord& record,
                   const StudyOptions& options) {
  return {ResultStore(options.folder, options.run), plan.workloads[task.workload].name, record.frames_digest};
}

Result<void> store_rows(const TaskFiles& files, const std::vector<SchemeSpec>& specs, const ModelRows& rows,
                        bool with_metrics) {
  Result<void> stored;
  for (size_t i = 0; stored && i < specs.size(); ++i)
    stored = store_text_file(files.result(specs[i]), rows.schemes[i]);
  if (stored && with_metrics) stored = store_text_file(files.colors(), rows.colors);
  if (stored && with_metrics) stored = store_text_file(files.frames(), rows.frames);
  return stored;
}

/// Nothing if a signal came.
Result<std::optional<uint64_t>> model_and_store(const TaskFiles& files, const std::vector<SchemeSpec>& specs,
                                                bool with_metrics, const OpenFeed& open,
                                                const StudyOptions& options, const std::atomic<int>& stop,
                                                std::atomic<uint64_t>& frames_done) {
  auto feed = open();
  if (!feed) return feed.error();
  RunOptions run = options.run;
  run.schemes = specs;
  const auto rows = model_frames(**feed, run, with_metrics, stop, frames_done);
  if (!rows) return rows.error();
  if (!*rows) return std::optional<uint64_t>();
  if ((*rows)->frame_count == 0)
    return Error{ErrorKind::kFile, files.workload + ": --frames and --every select none of its frames"};
  for (const std::string& line : (*rows)->skipped) say(MessageLevel::kWarning, files.workload + ": " + line);
  const auto stored = store_rows(files, specs, **rows, with_metrics);
  if (!stored) return stored.error();
  return std::optional((*rows)->frame_count);
}

}  // namespace

std::vector<SchemeSpec> missing_configurations(const StudyPlan& plan, const StudyTask& task,
                                               const WorkloadRecord& record, const StudyOptions& options) {
  const TaskFiles files = files_of(plan, task, record, options);
  std::vector<SchemeSpec> missing;
  for (const size_t i : task.configurations)
    if (!is_there(files.result(plan.study.configurations[i])))
      missing.push_back(plan.study.configurations[i]);
  return missing;
}

Result<TaskOutcome> run_task(const StudyPlan& plan, const StudyTask& task, const PreparedWorkload& prepared,
                             const StudyOptions& options, const std::atomic<int>& stop,
                             std::atomic<uint64_t>& frames_done) {
  if (!prepared.record.has_frames()) return TaskOutcome{TaskEnd::kNoFrames};
  const TaskFiles files = files_of(plan, task, prepared.record, options);
  // The first task of a workload also stores the metrics of the frames.
  const bool first = task.configurations.front() == 0;
  TaskLock lock;
  const auto missing_now = [&] { return missing_configurations(plan, task, prepared.record, options); };
  const auto metrics_missing = [&] { return first && !is_there(files.frames()); };
  TaskOutcome outcome{TaskEnd::kKept, 0, task.configurations.size()};
  if (!prepared.open || (missing_now().empty() && !metrics_missing())) return outcome;
  const auto taken = lock.take(options.folder, task.id);
  if (!taken) return taken.error();
  if (!*taken) return TaskOutcome{TaskEnd::kElsewhere};
  const std::vector<SchemeSpec> missing = missing_now();
  const bool with_metrics = metrics_missing();
  if (missing.empty() && !with_metrics) return outcome;

  const auto begin = std::chrono::steady_clock::now();
  const auto modelled =
      model_and_store(files, missing, with_metrics, prepared.open, options, stop, frames_done);
  if (modelled && !*modelled) return TaskOutcome{TaskEnd::kInterrupted};
  TaskRecord record{modelled ? "" : modelled.error().text, host_name(), TILEPRESS_VERSION, utc_time(), 0, 0};
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (modelled) record.frames = **modelled;
  const auto noted = store_task_record(options.folder, task.id, record);
  if (!modelled) return modelled.error();
  if (!noted) return noted.error();
  outcome.end = TaskEnd::kComputed;
  outcome.computed = missing.size();
  outcome.kept -= missing.size();
  return outcome;
}

}  // namespace tilepress
