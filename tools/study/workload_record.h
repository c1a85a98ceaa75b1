// Workload record: what is known of a workload's frames, kept in the study folder.
#pragma once

#include <cstdint>
#include <string>

#include "study/inputs.h"

namespace tilepress {

/// Texts are empty where they do not apply.
struct WorkloadRecord {
  std::string state = "done";  ///< done, partial, failed, unsupported, missing
  std::string reason;          ///< one line, unless done
  std::string kind;            ///< name_of(WorkloadKind)
  std::string source;          ///< path, or the folder of images
  std::string source_sha256;   ///< of the trace, the cache file or schemes.csv; of images that of their digests
  std::string frames_digest;   ///< equal for equal frames; empty without frames
  std::string frames_file;     ///< the cache file
  std::string gl_renderer, gl_version, retracer;
  std::string rendered;  ///< UTC
  std::string prepared, host, version;
  uint64_t frames = 0;  ///< that can be modelled; 0 = not counted

  bool has_frames() const { return !frames_digest.empty(); }
};

/// Reads DIR/workloads/NAME.json. Error: kFile if there is no such file.
Result<WorkloadRecord> load_workload_record(const std::string& folder, const std::string& workload);
Result<void> store_workload_record(const std::string& folder, const std::string& workload,
                                   const WorkloadRecord& record);

/// "2026-11-28T23:05:06Z"
std::string utc_time();

}  // namespace tilepress
