// Descriptors: open(2), then a number out of the program's way.
#include "run/descriptors.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>

#include "system_calls.h"

namespace tilepress {
namespace {

constexpr int kAfterStreams = 3;
constexpr long kCloseRange = 436;  // the same on every architecture
constexpr unsigned kUnshare = 2;   // CLOSE_RANGE_UNSHARE

thread_local bool has_own_table = false;

}  // namespace

int open_above_streams(const std::string& path, int flags, mode_t mode, int lowest) {
  const int first = open(path.c_str(), flags | O_CLOEXEC, mode);
  if (first < 0 || first >= lowest || has_own_table) return first;
  int moved = fcntl(first, F_DUPFD_CLOEXEC, lowest);
  if (moved < 0 && first >= kAfterStreams) return first;
  if (moved < 0) moved = fcntl(first, F_DUPFD_CLOEXEC, kAfterStreams);
  const int error = errno == EINVAL ? EMFILE : errno;
  close(first);
  if (moved < 0 && (flags & O_EXCL) != 0) unlink(path.c_str());
  errno = error;
  return moved;
}

bool leave_descriptors_of_program() {
  if (has_own_table) return true;
  // A system call filter may answer an unknown call by a signal.
  if (system_call(SYS_prctl, PR_GET_SECCOMP) != 0) return false;
  has_own_table = system_call(kCloseRange, 0, ~0u, kUnshare) == 0;
  return has_own_table;
}

}  // namespace tilepress
