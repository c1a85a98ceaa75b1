// Trace input: the bytes of a trace file, from disk or from memory.
#include "trace_input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "trace_fault.h"

namespace tilepress {

TraceInput::TraceInput(const std::string& path, std::string& error) : size_(UINT64_MAX) {
  // O_NONBLOCK: opening a named pipe nobody writes to must not hang.
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) {
    error = std::strerror(errno);
    return;
  }
  struct stat status;
  if (::fstat(fd, &status) != 0) {
    error = std::strerror(errno);
  } else if (S_ISDIR(status.st_mode)) {
    error = "is a directory, not a trace";
  } else if (!S_ISREG(status.st_mode)) {
    error = "is not a regular file";
  } else {
    fd_ = fd;
    size_ = static_cast<uint64_t>(status.st_size);
    return;
  }
  ::close(fd);
}

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
    if (got < 0)
      throw TraceFault{TraceState::kTruncated, std::string("cannot be read: ") + std::strerror(errno)};
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
