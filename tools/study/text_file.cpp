// Text file: written under a temporary name, flushed, renamed.
#include "text_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>

#include "study/cache/host_name.h"
#include "tilepress/file_error.h"

namespace tilepress {
namespace {

/// Returns 0 or the number of the error.
int write_and_flush(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(fd, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return written == 0 ? ENOSPC : errno;
    text.remove_prefix(static_cast<size_t>(written));
  }
  while (fsync(fd) != 0) {
    if (errno == EINVAL || errno == ENOTSUP) return 0;  // a file system that cannot flush
    if (errno != EINTR) return errno;
  }
  return 0;
}

}  // namespace

Result<void> store_text_file(const std::string& path, std::string_view text) {
  static std::atomic<uint64_t> count{0};
  std::error_code code;
  if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder, code);
  if (code) return Error{ErrorKind::kFile, path + ": " + code.message()};
  const std::string beside =
      path + "." + host_name() + "-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ".part";
  const int fd = open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0) return file_error(path);
  int error = write_and_flush(fd, text);
  if (close(fd) != 0 && error == 0) error = errno;
  if (error == 0 && rename(beside.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return {};
  unlink(beside.c_str());
  return file_error(path, error);
}

}  // namespace tilepress
