// Study plan: chunks and tasks.
#include "study_plan.h"

#include <algorithm>

#include "counted.h"
#include "study/bounds/bound_coders.h"
#include "study/configuration.h"
#include "tilepress/file_digest.h"

namespace tilepress {
namespace {

constexpr size_t kIdDigits = 10;

/// Equal for configurations that share tables: the values of all their keys.
std::string shared_tables(const SchemeSpec& spec) {
  std::string out;
  for (const auto& [key, value] : key_values(spec)) out += std::string(key) + "=" + value + ",";
  return out;
}

std::string task_id(const Workload& workload, const StudyFile& study, const std::vector<size_t>& chunk,
                    const RunOptions& run) {
  RunOptions options = run;
  options.schemes.clear();
  for (const size_t i : chunk) options.schemes.push_back(study.configurations[i]);
  const auto digest = sha256_of_bytes(rows_fingerprint(options));
  return workload.name + "-" + (digest ? digest->substr(0, kIdDigits) : std::to_string(chunk.front()));
}

}  // namespace

std::vector<std::vector<size_t>> chunk_configurations(const std::vector<SchemeSpec>& configurations,
                                                      size_t chunk) {
  std::vector<std::pair<std::string, std::vector<size_t>>> groups;
  for (size_t i = 0; i < configurations.size(); ++i) {
    const std::string tables = shared_tables(configurations[i]);
    auto group = std::ranges::find(groups, tables, [](const auto& known) { return known.first; });
    if (group == groups.end()) group = groups.insert(groups.end(), {tables, {}});
    group->second.push_back(i);
  }
  std::vector<std::vector<size_t>> chunks;
  for (const auto& [tables, members] : groups) {
    if (chunks.empty() || chunks.back().size() + members.size() > std::max<size_t>(1, chunk)) chunks.emplace_back();
    chunks.back().insert(chunks.back().end(), members.begin(), members.end());
  }
  return chunks;
}

std::vector<StudyTask> plan_tasks(const StudyFile& study, const std::vector<Workload>& workloads,
                                  const StudyOptions& options) {
  const auto chunks = chunk_configurations(study.configurations, options.chunk);
  const auto whole = chunk_configurations(study.configurations, study.configurations.size());
  std::vector<StudyTask> tasks;
  for (size_t workload = 0; workload < workloads.size(); ++workload) {
    const bool is_run = workloads[workload].kind == WorkloadKind::kRun;
    for (const auto& chunk : is_run ? whole : chunks)
      tasks.push_back({task_id(workloads[workload], study, chunk, options.run), workload, chunk, 0});
    if (is_run) continue;
    for (const uint32_t burst_bits : further_bursts(study, options))
      for (const auto& chunk : chunks) {
        StudyTask task{"", workload, chunk, burst_bits};
        task.id = task_id(workloads[workload], study, chunk, run_options_of(task, options));
        tasks.push_back(std::move(task));
      }
    if (options.bounds)
      tasks.push_back({task_id(workloads[workload], study, {}, options.run) + "-bounds", workload, {}, 0});
  }
  return tasks;
}

RunOptions run_options_of(const StudyTask& task, const StudyOptions& options) {
  RunOptions run = options.run;
  if (task.burst_bits != 0) run.model.burst_bits = task.burst_bits;
  return run;
}

std::vector<uint32_t> further_bursts(const StudyFile& study, const StudyOptions& options) {
  std::vector<uint32_t> bursts = study.bursts;
  std::erase(bursts, options.run.model.burst_bits);
  return bursts;
}

std::string task_content(const StudyTask& task) {
  const std::string count = counted(result_count(task), task.is_bounds() ? "bound" : "configuration");
  return task.burst_bits == 0 ? count : count + " at burst " + std::to_string(task.burst_bits);
}

size_t result_count(const StudyTask& task) {
  return task.is_bounds() ? bound_names().size() : task.configurations.size();
}

}  // namespace tilepress
