// Workload record: a JSON object with a member per field.
#include "workload_record.h"

#include <ctime>

#include <nlohmann/json.hpp>

#include "study/text_file.h"

namespace tilepress {

// Outside the unnamed namespace, where the library finds the functions.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE_WITH_DEFAULT(WorkloadRecord, state, reason, kind, source, source_sha256,
                                                frames_digest, frames_file, gl_renderer, gl_version, retracer,
                                                rendered, prepared, host, version, frames)

namespace {

std::string path_of(const std::string& folder, const std::string& workload) {
  return folder + "/workloads/" + workload + ".json";
}

}  // namespace

Result<WorkloadRecord> load_workload_record(const std::string& folder, const std::string& workload) {
  const std::string path = path_of(folder, workload);
  const auto text = read_text_file(path);
  if (!text) return text.error();
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object()) return Error{ErrorKind::kFile, path + ": is no JSON object"};
  try {
    return json.get<WorkloadRecord>();
  } catch (const nlohmann::json::exception& error) {
    return Error{ErrorKind::kFile, path + ": " + error.what()};
  }
}

Result<void> store_workload_record(const std::string& folder, const std::string& workload,
                                   const WorkloadRecord& record) {
  const nlohmann::ordered_json json = nlohmann::json(record);
  return store_text_file(path_of(folder, workload),
                         json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

std::string utc_time() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace tilepress
