// Child process: runs a program in the foreground as if the caller had started it.
#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

struct ChildEnd {
  pid_t pid = 0;
  std::optional<int> exit_status;  ///< either this
  std::optional<int> signal;       ///< or this is set
  bool ended_by_limit = false;     ///< it was still running after its time limit
  bool told_to_end = false;        ///< we received SIGTERM or SIGHUP, or the terminal interrupted it
  /// The status as a shell reports it: the exit status, or 128 + signal.
  int status() const { return signal ? 128 + *signal : exit_status.value_or(0); }
  /// The same, or 0 if our own time limit ended it.
  int own_status() const { return ended_by_limit ? 0 : status(); }
};

/// Runs argv with `environment` added to ours and waits for it. The child shares standard input, output,
/// error and the terminal. While it runs, we ignore SIGINT and SIGQUIT, which the terminal sends to both, and
/// pass SIGTERM, SIGHUP, SIGUSR1 and SIGUSR2 on. After `limit_s` seconds (0 = no limit) it receives SIGTERM,
/// and SIGKILL ten seconds later. Error, the program first: kFile if it is missing, kUnsupported if it cannot
/// be executed, kSystem otherwise.
Result<ChildEnd> run_child(const std::vector<std::string>& argv,
                           const std::map<std::string, std::string>& environment, double limit_s = 0);

/// The exit status for an error of run_child() or find_program(): 127, 126 or 125.
int start_status(const Error& error);

}  // namespace tilepress
