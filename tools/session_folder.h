// Session folder: where the shims of one `tilepress run` note what they saw and where they write.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace tilepress {

/// One run folder that a process under the shim has made.
struct CapturedProcess {
  pid_t pid = 0;
  std::string run_path;
};

/// A private temporary folder, removed with the object. Shims in the processes of the session append lines to
/// `<pid>.seen`
/// ("program entry road") and `<pid>.run` (path of a run folder); `log` takes their messages.
class SessionFolder {
 public:
  SessionFolder() = default;
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;
  ~SessionFolder();
  /// False and one line in `error` if no temporary folder can be made.
  bool create(std::string& error);
  const std::string& path() const { return path_; }
  std::string log_path() const { return path_ + "/log"; }

  /// LD_PRELOAD separates by spaces and colons: gives a path to `library` that has neither, through a link in
  /// this folder if need be.
  std::string preloadable(const std::string& library) const;

  /// In order of process number.
  std::vector<CapturedProcess> captured() const;
  /// "program: entry (road), entry (road)" for each program, sorted, each once.
  std::vector<std::string> seen() const;
  std::vector<std::string> log_lines() const;

 private:
  std::string path_;
};

}  // namespace tilepress
