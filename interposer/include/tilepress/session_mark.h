// Session mark: a small file that names the session of a run folder, so that a launcher finds its own runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tilepress {

/// In the run folder, until the run is closed.
constexpr const char* kSessionMarkFile = "session";

struct SessionMark {
  std::string session;         ///< name of the session folder
  int64_t pid = 0;             ///< in the PID namespace of the process
  uint64_t pid_namespace = 0;  ///< of the process; 0 = unknown, without /proc
};

/// The PID namespace of the calling process; 0 if unknown.
uint64_t own_pid_namespace();

/// Marks a run as made by process `pid` in the session of TILEPRESS_SESSION; does nothing without one.
void write_session_mark(const std::string& run_path, int64_t pid);
/// Nothing if the folder has no mark.
std::optional<SessionMark> read_session_mark(const std::string& run_path);

}  // namespace tilepress
