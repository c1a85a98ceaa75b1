// Piped file: plain reads, and a temporary file that is unlinked at once.
#include "frames/piped_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include "streams/ending_signals.h"

namespace tilepress {

ssize_t read_fully(int fd, std::byte* to, size_t size) {
  size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(fd, to + done, size - done);
    if (got < 0 && errno == EINTR && noted_signal() == 0) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    done += static_cast<size_t>(got);
  }
  return static_cast<ssize_t>(done);
}

std::shared_ptr<Pipe> Pipe::open(const std::string& path, std::string& error) {
  const int fd = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd >= 0) return std::make_shared<Pipe>(fd);
  error = path + ": " + std::strerror(errno);
  return nullptr;
}

Pipe::~Pipe() {
  if (fd_ != STDIN_FILENO) close(fd_);
}

const std::string& Pipe::peek(size_t size) {
  const size_t known = peeked_.size();
  if (known >= size) return peeked_;
  peeked_.resize(size);
  const ssize_t got = read_fully(fd_, reinterpret_cast<std::byte*>(peeked_.data()) + known, size - known);
  peeked_.resize(known + static_cast<size_t>(std::max<ssize_t>(got, 0)));
  return peeked_;
}

ssize_t Pipe::read(std::byte* to, size_t size) {
  const size_t known = std::min(peeked_.size(), size);
  std::memcpy(to, peeked_.data(), known);
  peeked_.erase(0, known);
  const ssize_t got = read_fully(fd_, to + known, size - known);
  return got < 0 ? got : got + static_cast<ssize_t>(known);
}

std::shared_ptr<Pipe> copy_to_file(Pipe& from, std::string& reason) {
  std::error_code code;
  std::string name = (std::filesystem::temp_directory_path(code) / "tilepress-XXXXXX").string();
  const int fd = mkostemp(name.data(), O_CLOEXEC);
  if (fd < 0) {
    reason = name + ": " + std::strerror(errno);
    return nullptr;
  }
  unlink(name.c_str());
  auto file = std::make_shared<Pipe>(fd);
  std::vector<std::byte> buffer(size_t{1} << 18);
  for (ssize_t got; (got = from.read(buffer.data(), buffer.size())) != 0;) {
    if (got > 0 && write(fd, buffer.data(), static_cast<size_t>(got)) == got) continue;
    reason = std::string("cannot be copied to a temporary file: ") + std::strerror(errno);
    return nullptr;
  }
  return file;
}

std::string path_of(const Pipe& file) { return "/proc/self/fd/" + std::to_string(file.fd()); }

}  // namespace tilepress
