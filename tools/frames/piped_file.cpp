// Piped file: plain reads, and a temporary file that is unlinked at once.
#include "frames/piped_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "streams/ending_signals.h"

namespace tilepress {

Result<size_t> read_fully(int fd, std::byte* to, size_t size) {
  size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(fd, to + done, size - done);
    if (got < 0 && errno == EINTR && noted_signal() == 0) continue;
    if (got < 0) return Error{ErrorKind::kFile, std::strerror(errno)};
    if (got == 0) break;
    done += static_cast<size_t>(got);
  }
  return done;
}

Result<std::shared_ptr<Pipe>> Pipe::open(const std::string& path) {
  const int fd = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return Error{ErrorKind::kFile, std::strerror(errno)};
  return std::make_shared<Pipe>(fd);
}

Pipe::~Pipe() {
  if (fd_ != STDIN_FILENO) close(fd_);
}

const std::string& Pipe::peek(size_t size) {
  const size_t known = peeked_.size();
  if (known >= size) return peeked_;
  peeked_.resize(size);
  const auto got = read_fully(fd_, reinterpret_cast<std::byte*>(peeked_.data()) + known, size - known);
  peeked_.resize(known + (got ? *got : 0));
  return peeked_;
}

Result<size_t> Pipe::read(std::byte* to, size_t size) {
  const size_t known = std::min(peeked_.size(), size);
  std::memcpy(to, peeked_.data(), known);
  peeked_.erase(0, known);
  auto got = read_fully(fd_, to + known, size - known);
  if (got) *got += known;
  return got;
}

Result<std::shared_ptr<Pipe>> copy_to_file(Pipe& from) {
  std::error_code code;
  std::string name = (std::filesystem::temp_directory_path(code) / "tilepress-XXXXXX").string();
  const int fd = mkostemp(name.data(), O_CLOEXEC);
  if (fd < 0) return Error{ErrorKind::kFile, name + ": " + std::strerror(errno)};
  unlink(name.c_str());
  auto file = std::make_shared<Pipe>(fd);
  std::vector<std::byte> buffer(size_t{1} << 18);
  const std::string failure = "cannot be copied to a temporary file";
  for (;;) {
    const auto got = from.read(buffer.data(), buffer.size());
    if (!got) return about(failure, got.error());
    if (*got == 0) return file;
    if (write(fd, buffer.data(), *got) != static_cast<ssize_t>(*got))
      return Error{ErrorKind::kFile, failure + ": " + std::strerror(errno)};
  }
}

}  // namespace tilepress
