// Standard streams: stdout writes through a function that keeps the first error.
#include "streams/standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>

namespace tilepress {
namespace {

int first_error = 0;  ///< errno of the first write that failed
bool failed = false;
struct sigaction callers_sigpipe;

std::mutex guard;
int holders = 0;             ///< standard error leads nowhere from the first to the last
std::atomic<int> kept = -1;  ///< a copy of the true standard error, made once

/// stdio keeps only the error of the last write. Returns fewer than `count` bytes on failure.
ssize_t write_noting_errors(void*, const char* bytes, size_t count) {
  size_t done = 0;
  while (done < count && first_error == 0) {
    const ssize_t written = write(STDOUT_FILENO, bytes + done, count - done);
    if (written > 0) {
      done += static_cast<size_t>(written);
    } else if (written < 0 && errno == EAGAIN) {  // the caller's pipe does not block
      pollfd ready = {STDOUT_FILENO, POLLOUT, 0};
      poll(&ready, 1, -1);
    } else if (written == 0 || errno != EINTR) {
      first_error = written == 0 ? ENOSPC : errno;
    }
  }
  return static_cast<ssize_t>(done);
}

/// Opens a closed standard stream in its unused direction: reads and writes fail as before.
void occupy(int stream) {
  if (fcntl(stream, F_GETFD) >= 0) return;
  const int flags = (stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) | O_CLOEXEC;
  // The lowest free number is `stream`. A private root may have no /dev.
  if (open("/dev/null", flags) < 0 && open("/", O_PATH | O_CLOEXEC) < 0) return;
}

}  // namespace

void guard_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) occupy(stream);
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, &callers_sigpipe);
  std::FILE* noting = fopencookie(nullptr, "w", {nullptr, write_noting_errors, nullptr, nullptr});
  if (noting == nullptr) return;
  std::setvbuf(noting, nullptr, isatty(STDOUT_FILENO) != 0 ? _IOLBF : _IOFBF, BUFSIZ);
  stdout = noting;
}

void restore_sigpipe() {
  sigaction(SIGPIPE, &callers_sigpipe, nullptr);
}

Result<void> flush_standard_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return {};
  failed = true;
  const int code = first_error != 0 ? first_error : errno;
  return Error{ErrorKind::kFile, std::string("standard output: ") + std::strerror(code)};
}

bool standard_output_has_failed() {
  return failed;
}

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
