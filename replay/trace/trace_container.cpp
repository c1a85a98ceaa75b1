// Trace container: recognises the file by its first bytes.
#include "trace_container.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace tilepress {

Result<TraceInput> TraceInput::open(const std::string& path) {
  // O_NONBLOCK: opening a named pipe without a writer must not hang.
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat status;
  if (fd < 0 || ::fstat(fd, &status) != 0) return Error{ErrorKind::kFile, std::strerror(errno)};
  TraceInput input(fdopen(fd, "rb"), static_cast<uint64_t>(status.st_size));
  if (S_ISDIR(status.st_mode)) return Error{ErrorKind::kUnsupported, "is a directory, not a trace"};
  if (!S_ISREG(status.st_mode)) return Error{ErrorKind::kUnsupported, "is not a regular file"};
  return input;
}

TraceInput::TraceInput(std::span<const uint8_t> memory)
    : TraceInput(fmemopen(const_cast<uint8_t*>(memory.data()), memory.size(), "rb"), memory.size()) {}

size_t TraceInput::read(std::span<uint8_t> to) {
  const size_t filled = std::fread(to.data(), 1, to.size(), file_.get());
  if (std::ferror(file_.get()) != 0) fail_truncated(std::string("cannot be read: ") + std::strerror(errno));
  return filled;
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
