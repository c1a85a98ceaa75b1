// Study results: one file per workload and configuration.
#include "study_results.h"

#include <filesystem>

#include "counted.h"
#include "study/bounds/bound_coders.h"
#include "study/result_store.h"
#include "study/task_state.h"
#include "study/text_file.h"
#include "tilepress/csv_rows.h"
#include "tilepress/run_info.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {
namespace {

/// The text of a file, or nothing if there is no such file.
Result<std::optional<std::string>> text_if_there(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) return std::optional<std::string>();
  auto text = read_text_file(path);
  if (!text) return text.error();
  return std::optional(std::move(*text));
}

Result<std::vector<FrameStatistics>> read_frames(const std::string& text) {
  CsvRecords records(text);
  const CsvRowReader<FrameStatistics> reader(records, frame_columns());
  std::vector<FrameStatistics> frames;
  while (records.next()) {
    FrameStatistics frame;
    if (const auto read = reader.read(frame); !read) return read.error();
    if (!is_target(frame.surface)) frames.push_back(frame);
  }
  return frames;
}

/// Why results of the workload are missing.
std::string missing_reason(const StudyPlan& plan, size_t workload, const StudyOptions& options, size_t missing) {
  for (const StudyTask& task : plan.tasks) {
    if (task.workload != workload) continue;
    const auto record = load_task_record(options.folder, task.id);
    if (record && !record->reason.empty()) return record->reason;
  }
  return counted(missing, "result") + (missing == 1 ? " is" : " are") + " not computed";
}

/// The sums of a file of rows, or nothing if there is no such file.
Result<std::optional<ResultSums>> sums_if_there(const std::string& path, uint32_t burst_bits, bool with_frames) {
  const auto text = text_if_there(path);
  if (!text) return text.error();
  if (!*text) return std::optional<ResultSums>();
  auto sums = sum_result_rows(**text, burst_bits, with_frames);
  if (!sums) return about(path, sums.error());
  return std::optional(std::move(*sums));
}

/// The sums of every configuration under these options. Counts those that are missing.
Result<std::vector<std::optional<ResultSums>>> load_sums(const StudyPlan& plan, const Workload& workload,
                                                         const WorkloadRecord& record, const StudyOptions& options,
                                                         const RunOptions& run, size_t& missing) {
  const ResultStore store(options.folder, run);
  std::vector<std::optional<ResultSums>> out;
  for (const SchemeSpec& spec : plan.study.configurations) {
    auto sums = sums_if_there(store.result_path(workload.name, record.frames_digest, spec), run.model.burst_bits,
                              spec.text == plan.study.baseline);
    if (!sums) return sums.error();
    missing += !*sums;
    out.push_back(std::move(*sums));
  }
  return out;
}

Result<WorkloadResults> load_workload(const StudyPlan& plan, size_t number, const StudyOptions& options) {
  const Workload& workload = plan.workloads[number];
  WorkloadResults out;
  out.sums.resize(plan.study.configurations.size());
  const auto record = load_workload_record(options.folder, workload.name);
  if (!record) {
    out.record.state = "missing";
    out.record.reason = "not computed";
    out.record.kind = name_of(workload.kind);
    out.record.source = workload.paths[0];
    return out;
  }
  out.record = *record;
  if (!record->has_frames()) return out;
  const ResultStore store(options.folder, options.run);
  const uint32_t burst_bits = options.run.model.burst_bits;
  size_t missing = 0;
  auto sums = load_sums(plan, workload, *record, options, options.run, missing);
  if (!sums) return sums.error();
  out.sums = std::move(*sums);
  const bool is_run = workload.kind == WorkloadKind::kRun;
  for (const uint32_t burst : is_run ? std::vector<uint32_t>() : further_bursts(plan.study, options)) {
    auto further = load_sums(plan, workload, *record, options, run_options_of({"", 0, {}, burst}, options), missing);
    if (!further) return further.error();
    out.at_bursts[burst] = std::move(*further);
  }
  if (options.bounds && !is_run)
    for (const std::string& name : bound_names()) {
      auto bound = sums_if_there(store.bound_path(workload.name, record->frames_digest, name), burst_bits, false);
      if (!bound) return bound.error();
      missing += !*bound;
      out.bounds.push_back(std::move(*bound));
    }
  const auto frames = text_if_there(store.frames_path(workload.name, record->frames_digest));
  const auto colors = text_if_there(store.colors_path(workload.name, record->frames_digest));
  if (!frames || !colors) return (frames ? colors : frames).error();
  if (*frames) {
    auto read = read_frames(**frames);
    if (!read) return about(workload.name, read.error());
    out.frames = std::move(*read);
  }
  out.colors = colors->value_or("");
  if (missing > 0 && out.record.state == "done") {
    out.record.state = "partial";
    out.record.reason = missing_reason(plan, number, options, missing);
  }
  return out;
}

}  // namespace

Result<std::vector<WorkloadResults>> load_study_results(const StudyPlan& plan, const StudyOptions& options) {
  std::vector<WorkloadResults> out;
  for (size_t i = 0; i < plan.workloads.size(); ++i) {
    auto results = load_workload(plan, i, options);
    if (!results) return results.error();
    out.push_back(std::move(*results));
  }
  return out;
}

}  // namespace tilepress
