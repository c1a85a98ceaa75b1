// Study records: a JSON object with a member per field.
#include "study_records.h"

#include <nlohmann/json.hpp>

#include "study/text_file.h"
#include "tilepress/whole_file.h"

namespace tilepress {

// Outside the unnamed namespace, where the library finds the functions.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WorkloadRecord, state, reason, kind, source, source_sha256,
                                                frames_digest, frames_file, gl_renderer, gl_version, retracer,
                                                rendered, prepared, host, version, frames)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(TaskRecord, reason, host, version, date, seconds, frames)

namespace {

template <class Record>
std::optional<Record> load(const std::string& path) {
  const auto text = read_whole_file(path);
  if (!text) return std::nullopt;
  try {
    return nlohmann::json::parse(*text).get<Record>();
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

template <class Record>
Result<void> store(const std::string& path, const Record& record) {
  return store_text_file(
      path, nlohmann::json(record).dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace

std::optional<WorkloadRecord> load_workload_record(const std::string& folder, const std::string& workload) {
  return load<WorkloadRecord>(folder + "/workloads/" + workload + ".json");
}

Result<void> store_workload_record(const std::string& folder, const std::string& workload,
                                   const WorkloadRecord& record) {
  return store(folder + "/workloads/" + workload + ".json", record);
}

std::optional<TaskRecord> load_task_record(const std::string& folder, const std::string& task) {
  return load<TaskRecord>(folder + "/tasks/" + task + ".json");
}

Result<void> store_task_record(const std::string& folder, const std::string& task, const TaskRecord& record) {
  return store(folder + "/tasks/" + task + ".json", record);
}

}  // namespace tilepress
