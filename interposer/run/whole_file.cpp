// Whole file: plain calls of the system, because standard streams lose the reason of a failure.
#include "tilepress/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include "run/descriptors.h"
#include "tilepress/file_error.h"

namespace tilepress {

Result<std::string> read_whole_file(const std::string& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return file_error(path);
  std::string text;
  char buffer[1 << 16];
  ssize_t got = 0;
  while ((got = read(fd, buffer, sizeof buffer)) > 0 || (got < 0 && errno == EINTR))
    if (got > 0) text.append(buffer, static_cast<size_t>(got));
  const int error = errno;
  close(fd);
  if (got < 0) return file_error(path, error);
  return text;
}

Result<void> write_whole_bytes(const std::string& path, std::string_view bytes, mode_t mode) {
  const int fd = open_above_streams(path, O_WRONLY | O_CREAT | O_TRUNC, mode);
  if (fd < 0) return file_error(path);
  int error = 0;
  while (error == 0 && !bytes.empty()) {
    const ssize_t written = write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written > 0) bytes.remove_prefix(static_cast<size_t>(written));
    if (written <= 0) error = written == 0 ? ENOSPC : errno;
  }
  close(fd);
  errno = error;
  return error == 0 ? Result<void>() : file_error(path);
}

Result<void> replace_file(const std::string& path, std::string_view text) {
  const std::string beside = path + ".tmp";
  Result<void> done = write_whole_bytes(beside, text, 0644);
  if (done && rename(beside.c_str(), path.c_str()) != 0) done = file_error(path);
  if (!done) unlink(beside.c_str());
  return done;
}

}  // namespace tilepress
