// Child process: runs a program in the foreground as if it had been started directly.
#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tilepress {

/// What stands in the way of starting a program, with its exit status (spec §12).
struct StartFailure {
  int status;          ///< kExitNotFound, kExitNotExecutable or kExitLauncherFailed
  std::string reason;  ///< one line, the program's name first
};

/// The file that execvp would run for `name`; fills `failure` and returns nothing if there is none to run.
std::optional<std::string> find_program(const std::string& name, StartFailure& failure);

struct ChildEnd {
  pid_t pid = 0;
  std::optional<int> exit_status;  ///< either this
  std::optional<int> signal;       ///< or this is set
  bool ended_by_limit = false;     ///< it was still running at the end of its time
  bool told_to_end = false;  ///< we were sent SIGTERM or SIGHUP, or it was interrupted from the terminal
  /// As a shell tells it: the status, or 128 + signal.
  int status() const { return signal ? 128 + *signal : exit_status.value_or(0); }
};

/// Runs argv with `environment` added to ours and waits for it. The child shares standard input, output,
/// error and the terminal. While it runs, SIGINT and SIGQUIT (which the terminal sends to both) are left to
/// it and SIGTERM, SIGHUP, SIGUSR1 and SIGUSR2 are passed on. After `limit_s` seconds (0 = no limit) it is
/// sent SIGTERM, and SIGKILL ten seconds later. Nothing and `failure` if it could not be started.
std::optional<ChildEnd> run_child(const std::vector<std::string>& argv,
                                  const std::map<std::string, std::string>& environment,
                                  StartFailure& failure, double limit_s = 0);

}  // namespace tilepress
