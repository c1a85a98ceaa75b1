// Quiet standard error: descriptor 2 leads nowhere from the first holder to the last.
#include "streams/quiet_standard_error.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <mutex>

namespace tilepress {
namespace {

std::mutex guard;
int holders = 0;
std::atomic<int> kept = -1;  ///< a copy of the true standard error, made once

}  // namespace

QuietStandardError::QuietStandardError() {
  const std::lock_guard lock(guard);
  if (holders++ > 0) return;
  if (kept < 0) kept = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (kept >= 0 && nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  if (nowhere >= 0) close(nowhere);
}

QuietStandardError::~QuietStandardError() {
  const std::lock_guard lock(guard);
  if (--holders == 0 && kept >= 0) dup2(kept, STDERR_FILENO);
}

int true_standard_error() {
  const int fd = kept;
  return fd >= 0 ? fd : STDERR_FILENO;
}

}  // namespace tilepress
