// Trace input: read() of a descriptor or of a span.
#include "trace_input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "trace_fault.h"

namespace tilepress {

Result<TraceInput> TraceInput::open(const std::string& path) {
  // O_NONBLOCK: opening a named pipe without a writer must not hang.
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  TraceInput input(fd, 0);
  struct stat status;
  if (fd < 0 || ::fstat(fd, &status) != 0) return Error{ErrorKind::kFile, std::strerror(errno)};
  if (S_ISDIR(status.st_mode)) return Error{ErrorKind::kUnsupported, "is a directory, not a trace"};
  if (!S_ISREG(status.st_mode)) return Error{ErrorKind::kUnsupported, "is not a regular file"};
  input.size_ = static_cast<uint64_t>(status.st_size);
  return input;
}

TraceInput::TraceInput(TraceInput&& other) noexcept
    : memory_(other.memory_),
      fd_(std::exchange(other.fd_, -1)),
      size_(other.size_),
      position_(other.position_) {}

TraceInput::~TraceInput() {
  if (fd_ >= 0) ::close(fd_);
}

size_t TraceInput::read(std::span<uint8_t> to) {
  size_t filled = 0;
  if (fd_ < 0) {
    filled = static_cast<size_t>(std::min<uint64_t>(to.size(), memory_.size() - position_));
    if (filled > 0) std::memcpy(to.data(), memory_.data() + position_, filled);
  }
  while (fd_ >= 0 && filled < to.size()) {
    const ssize_t got = ::read(fd_, to.data() + filled, to.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_truncated(std::string("cannot be read: ") + std::strerror(errno));
    if (got == 0) break;
    filled += static_cast<size_t>(got);
  }
  position_ += filled;
  return filled;
}

void TraceInput::rewind() {
  if (fd_ >= 0) ::lseek(fd_, 0, SEEK_SET);
  position_ = 0;
}

}  // namespace tilepress
