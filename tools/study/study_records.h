// Study records: what is known of a study's workloads and tasks, as JSON files that every process on a shared
// folder sees.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// What is known of a workload's frames. Texts are empty where they do not apply.
struct WorkloadRecord {
  std::string state = "done";  ///< done, partial, failed, unsupported, missing
  std::string reason;          ///< one line, unless done
  std::string kind;            ///< name_of(WorkloadKind)
  std::string source;          ///< path, or the folder of images
  std::string
      source_sha256;  ///< of the trace, the cache file or schemes.csv; of images that of their digests
  std::string frames_digest;  ///< equal for equal frames; empty without frames
  std::string frames_file;    ///< the cache file
  std::string gl_renderer, gl_version, retracer;
  std::string rendered;  ///< UTC
  std::string prepared, host, version;
  uint64_t frames = 0;  ///< that can be modelled; 0 = not counted

  bool has_frames() const { return !frames_digest.empty(); }
};

/// One try of a task.
struct TaskRecord {
  std::string reason;  ///< why it failed; empty if it is done
  std::string host, version, date;
  double seconds = 0;
  uint64_t frames = 0;  ///< that were modelled
};

/// Reads DIR/workloads/NAME.json. Nothing if the file is missing or damaged.
std::optional<WorkloadRecord> load_workload_record(const std::string& folder, const std::string& workload);
Result<void> store_workload_record(const std::string& folder, const std::string& workload,
                                   const WorkloadRecord& record);

/// Reads DIR/tasks/ID.json. Nothing if the task has not ended yet.
std::optional<TaskRecord> load_task_record(const std::string& folder, const std::string& task);
Result<void> store_task_record(const std::string& folder, const std::string& task, const TaskRecord& record);

}  // namespace tilepress
