// Run folder: makes a folder that programs of several users and namespaces write, and names its session.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "tilepress/result.h"

namespace tilepress {

/// Lets those who may write the parent of `folder` write `folder` too: gives it the parent's mode and, as far
/// as the system allows, the parent's owner and group. `extra_mode` is added to the mode.
void share_like_parent(const std::string& folder, unsigned extra_mode = 0);

/// Makes the folder `name`, `name`-2, `name`-3, … inside `output`: the first name that is free. Two processes
/// never get the same one, even with equal pids. A process of root shares the folder like its parent, because
/// it may change its user before the next frame. Returns the path.
Result<std::string> make_run_folder(const std::string& output, const std::string& name);

/// A small file in the run folder, until the run is closed. A launcher finds its own runs by it.
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
