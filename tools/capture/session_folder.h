// Session folder: the shims of one `tilepress run` note here what they saw.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// A process of the session that made a run folder.
struct CapturedProcess {
  int64_t pid = 0;             ///< in the process's own PID namespace
  uint64_t pid_namespace = 0;  ///< 0 = unknown
  std::string run_path;
};

/// A hidden folder inside the output folder, removed by the destructor. A program that can write its rows can
/// write here too, whatever its /tmp and its user are. Shims append lines "program entry road" to
/// `<pid>.seen` and messages to `log`. A shim without a free descriptor makes a symbolic link whose target is
/// the line. A shim that cannot reach the folder sends its lines to a socket named after the folder.
class SessionFolder {
 public:
  SessionFolder() = default;
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;
  ~SessionFolder();
  /// Makes the folder inside `output`, which exists. Error: kFile, the path first.
  Result<void> create(const std::string& output);
  const std::string& path() const { return path_; }
  std::string log_path() const { return path_ + "/log"; }

  /// The runs in the output folder that carry this session's mark, ordered by process number.
  std::vector<CapturedProcess> captured() const;
  /// "program: entry (road), entry (road)", one line for each program, sorted and without repeats.
  std::vector<std::string> seen() const;
  /// The same for processes that reached the socket and not the folder.
  std::vector<std::string> seen_from_afar() const;
  std::vector<std::string> log_lines() const;

 private:
  std::string output_, path_;
  int socket_ = -1;
};

}  // namespace tilepress
