// Trace container: recognises the file by its first bytes.
#include "trace_container.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

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

Result<std::unique_ptr<TraceContainer>> open_container(TraceInput& input) {
  std::array<uint8_t, 4> start{};
  const size_t length = input.read(start);
  input.rewind();
  if (length == 0) return Error{ErrorKind::kUnsupported, "is empty"};
  if (length >= 2 && start[0] == 'a' && start[1] == 't') return open_snappy_container(input);
  if (length >= 2 && start[0] == 0x1f && start[1] == 0x8b) return open_gzip_container(input);
  if (length == 4 && start[0] == 0x28 && start[1] == 0xb5 && start[2] == 0x2f && start[3] == 0xfd)
    return Error{ErrorKind::kUnsupported,
                 "is compressed with zstd, which Debian 12's retracer cannot read (apitrace repack --brotli "
                 "converts it)"};
  return open_brotli_container(input);  // which has no signature
}

}  // namespace tilepress
