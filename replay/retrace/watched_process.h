// Watched process: a background program whose standard error is read and which can be ended.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// The last lines of a stream. Long lines are cut.
class LastLines {
 public:
  void add(const char* bytes, size_t count);
  const std::deque<std::string>& lines() const { return lines_; }

 private:
  static constexpr size_t kMaxLines = 20, kMaxLineBytes = 400;
  std::deque<std::string> lines_;
  bool open_ = false;  ///< the last line has no end yet
};

/// The process leads a process group and dies with the thread that started it. Not thread-safe.
class WatchedProcess {
 public:
  WatchedProcess() = default;
  WatchedProcess(const WatchedProcess&) = delete;
  WatchedProcess& operator=(const WatchedProcess&) = delete;
  ~WatchedProcess();  ///< kills the group if the process still runs

  /// Starts argv, whose first word is a path. `environment` is added to ours; an empty value removes the
  /// variable. `kept_fd` stays open in the process unless it is -1. Error: kSystem, the path first.
  Result<void> start(const std::vector<std::string>& argv,
                     const std::map<std::string, std::string>& environment, int kept_fd = -1);
  /// Reads standard error until the process has ended or the time is over. Returns true once it has ended.
  bool wait(std::chrono::milliseconds time);
  /// Ends the group with SIGTERM, and with SIGKILL a second later.
  void end();

  std::optional<int> exit_status() const { return exit_status_; }
  std::optional<int> signal() const { return signal_; }
  /// Of standard error. Standard output goes nowhere.
  const LastLines& errors() const { return errors_; }

 private:
  bool running() const { return pid_ > 0 && !ended_; }
  void read_errors();
  bool reap(int flags);

  pid_t pid_ = -1;
  bool ended_ = false;
  int errors_fd_ = -1;
  std::optional<int> exit_status_, signal_;
  LastLines errors_;
};

}  // namespace tilepress
