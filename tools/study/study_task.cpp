// Study task: lock, model, store.
#include "study_task.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "streams/messages.h"
#include "study/bounds/bound_coders.h"
#include "study/bounds/model_bounds.h"
#include "study/cache/host_name.h"
#include "study/model_frames.h"
#include "study/result_store.h"
#include "study/task_state.h"
#include "study/text_file.h"
#include "tilepress/plugin_scheme.h"
#include "tilepress/utc_time.h"

namespace tilepress {
namespace {

bool is_there(const std::string& path) {
  std::error_code code;
  return std::filesystem::exists(path, code);
}

/// The results of a task that are not stored.
struct MissingWork {
  std::vector<SchemeSpec> specs;
  std::vector<std::string> bounds;
  bool metrics = false;  ///< the first task of a workload also stores the metrics of the frames
  size_t results() const { return specs.size() + bounds.size(); }
  bool any() const { return results() > 0 || metrics; }
};

/// The files of a task's workload.
ResultStore files_of(const StudyPlan& plan, const StudyTask& task, const WorkloadRecord& record,
                     const StudyOptions& options) {
  return {options.folder, run_options_of(task, options), plan.workloads[task.workload].name,
          record.frames_digest};
}

MissingWork missing_work(const StudyPlan& plan, const StudyTask& task, const ResultStore& files) {
  MissingWork missing;
  for (const size_t i : task.configurations)
    if (const SchemeSpec& spec = plan.study.configurations[i]; !is_there(files.result_path(spec)))
      missing.specs.push_back(spec);
  if (task.is_bounds()) {
    for (const std::string& name : bound_names())
      if (!is_there(files.bound_path(name))) missing.bounds.push_back(name);
  } else if (task.burst_bits == 0) {
    missing.metrics = task.configurations.front() == 0 && !is_there(files.frames_path());
  }
  return missing;
}

/// The bounds are computed together, and stored where they are missing.
Result<void> store_bounds(const ResultStore& files, const std::vector<std::string>& missing,
                          const ModelRows& rows) {
  const std::vector<std::string>& names = bound_names();
  Result<void> stored;
  for (size_t i = 0; stored && i < names.size(); ++i)
    if (std::ranges::find(missing, names[i]) != missing.end())
      stored = store_text_file(files.bound_path(names[i]), rows.schemes[i]);
  return stored;
}

Result<void> store_rows(const ResultStore& files, const MissingWork& work, const ModelRows& rows) {
  if (!work.bounds.empty()) return store_bounds(files, work.bounds, rows);
  Result<void> stored;
  for (size_t i = 0; stored && i < work.specs.size(); ++i)
    stored = store_text_file(files.result_path(work.specs[i]), rows.schemes[i]);
  if (stored && work.metrics) stored = store_text_file(files.colors_path(), rows.colors);
  if (stored && work.metrics) stored = store_text_file(files.frames_path(), rows.frames);
  return stored;
}

/// Nothing if a signal came.
Result<std::optional<uint64_t>> model_and_store(const std::string& workload, const ResultStore& files,
                                                const MissingWork& work, const OpenFeed& open, RunOptions run,
                                                const std::atomic<int>& stop,
                                                std::atomic<uint64_t>& frames_done) {
  const auto feed = open();
  if (!feed) return feed.error();
  run.schemes = work.specs;
  const auto rows = work.bounds.empty() ? model_frames(*feed, run, work.metrics, stop, frames_done)
                                        : model_bounds(*feed, run, stop, frames_done);
  if (!rows) return rows.error();
  if (!*rows) return std::optional<uint64_t>();
  if ((*rows)->frame_count == 0)
    return Error{ErrorKind::kFile, workload + ": --frames and --every select none of its frames"};
  for (const std::string& line : (*rows)->skipped) say(MessageLevel::kWarning, workload + ": " + line);
  const auto stored = store_rows(files, work, **rows);
  if (!stored) return stored.error();
  return std::optional((*rows)->frame_count);
}

}  // namespace

size_t missing_results(const StudyPlan& plan, const StudyTask& task, const WorkloadRecord& record,
                       const StudyOptions& options) {
  return missing_work(plan, task, files_of(plan, task, record, options)).results();
}

Result<TaskOutcome> run_task(const StudyPlan& plan, const StudyTask& task, const PreparedWorkload& prepared,
                             const StudyOptions& options, const std::atomic<int>& stop,
                             std::atomic<uint64_t>& frames_done) {
  if (!prepared.record.has_frames()) return TaskOutcome();
  const ResultStore files = files_of(plan, task, prepared.record, options);
  TaskLock lock;
  TaskOutcome outcome{.kept = result_count(task)};
  if (!prepared.open || !missing_work(plan, task, files).any()) return outcome;
  const auto taken = lock.take(options.folder, task.id);
  if (!taken) return taken.error();
  if (!*taken) return TaskOutcome{.elsewhere = true};
  const MissingWork missing = missing_work(plan, task, files);
  if (!missing.any()) return outcome;

  const auto begin = std::chrono::steady_clock::now();
  const auto modelled = catch_plugin_fault([&] {
    return model_and_store(plan.workloads[task.workload].name, files, missing, prepared.open,
                           run_options_of(task, options), stop, frames_done);
  });
  if (modelled && !*modelled) return TaskOutcome();
  TaskRecord record{modelled ? "" : modelled.error().text, host_name(), TILEPRESS_VERSION, utc_now(), 0, 0};
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (modelled) record.frames = **modelled;
  const auto noted = store_task_record(options.folder, task.id, record);
  if (!modelled) return modelled.error();
  if (!noted) return noted.error();
  outcome.computed = missing.results();
  outcome.kept -= missing.results();
  return outcome;
}

}  // namespace tilepress
