// Session folder: where the shims of one `tilepress run` note what they saw and which runs are theirs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tilepress {

/// One run folder that a process of the session has made.
struct CapturedProcess {
  int64_t pid = 0;             ///< as the process itself knows it
  uint64_t pid_namespace = 0;  ///< 0 = unknown
  std::string run_path;
};

/// A hidden folder inside the output folder, removed with the object. A program that can write its rows can
/// write here too, whatever it sees of /tmp and whichever user it is. Shims append lines "program entry road"
/// to `<pid>.seen`; `log` takes their messages. A shim that has no descriptor left makes a symbolic link with
/// the line as its target. A shim that does not reach the folder sends its lines to a socket of its name.
class SessionFolder {
 public:
  SessionFolder() = default;
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;
  ~SessionFolder();
  /// `output` exists. Returns false and one line in `error` on failure.
  bool create(const std::string& output, std::string& error);
  const std::string& path() const { return path_; }
  std::string log_path() const { return path_ + "/log"; }

  /// The runs in the output folder that are marked as of this session, in order of process number.
  std::vector<CapturedProcess> captured() const;
  /// "program: entry (road), entry (road)" for each program, sorted, each once.
  std::vector<std::string> seen() const;
  /// The same of the processes that did not reach this folder, as far as they reached the socket.
  std::vector<std::string> seen_from_afar() const;
  std::vector<std::string> log_lines() const;

 private:
  std::string output_, path_;
  int socket_ = -1;
};

}  // namespace tilepress
