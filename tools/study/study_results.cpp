// Study results: one file per workload and configuration.
#include "study_results.h"

#include <algorithm>
#include <filesystem>

#include "counted.h"
#include "study/bounds/bound_coders.h"
#include "study/result_store.h"
#include "tilepress/csv_rows.h"
#include "tilepress/run_info.h"
#include "tilepress/statistics_rows.h"
#include "tilepress/whole_file.h"

namespace tilepress {
namespace {

using SumsList = std::vector<std::optional<ResultSums>>;

/// The text of a file, or nothing if there is no such file.
Result<std::optional<std::string>> text_if_there(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code)) return std::optional<std::string>();
  auto text = read_whole_file(path);
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

/// Appends the sums of a file of rows, or nothing if there is no such file.
Result<void> append_sums(const std::string& path, uint32_t burst_bits, bool with_frames, SumsList& list) {
  auto& sums = list.emplace_back();
  const auto text = text_if_there(path);
  if (!text) return text.error();
  if (!*text) return {};
  auto read = sum_result_rows(**text, burst_bits, with_frames);
  if (!read) return about(path, read.error());
  sums = std::move(*read);
  return {};
}

/// The sums of every configuration.
Result<SumsList> load_sums(const StudyFile& study, const ResultStore& store, uint32_t burst_bits) {
  SumsList list;
  for (const SchemeSpec& spec : study.configurations)
    if (const auto done = append_sums(store.result_path(spec), burst_bits, spec.text == study.baseline, list);
        !done)
      return done.error();
  return list;
}

size_t missing_in(const SumsList& list) {
  return static_cast<size_t>(std::ranges::count_if(list, [](const auto& sums) { return !sums; }));
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
  const auto store_with = [&](const RunOptions& run) {
    return ResultStore(options.folder, run, workload.name, record->frames_digest);
  };
  const ResultStore store = store_with(options.run);
  const uint32_t own_burst = options.run.model.burst_bits;
  auto sums = load_sums(plan.study, store, own_burst);
  if (!sums) return sums.error();
  out.sums = std::move(*sums);
  size_t missing = missing_in(out.sums);
  const bool is_run = workload.kind == WorkloadKind::kRun;
  for (const uint32_t burst : is_run ? std::vector<uint32_t>() : further_bursts(plan.study, options)) {
    auto further = load_sums(plan.study, store_with(run_options_of({"", 0, {}, burst}, options)), burst);
    if (!further) return further.error();
    missing += missing_in(*further);
    out.at_bursts[burst] = std::move(*further);
  }
  for (const std::string& name : options.bounds && !is_run ? bound_names() : std::vector<std::string>())
    if (const auto done = append_sums(store.bound_path(name), own_burst, false, out.bounds); !done)
      return done.error();
  missing += missing_in(out.bounds);
  const auto frames = text_if_there(store.frames_path());
  const auto colors = text_if_there(store.colors_path());
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
