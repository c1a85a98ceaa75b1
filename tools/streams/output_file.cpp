// Output file: written beside its final name, renamed at the end.
#include "streams/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "streams/standard_streams.h"

namespace tilepress {
namespace {

constexpr size_t kBufferBytes = 1 << 16;

/// `path` with its symbolic links followed: a link stays, and the file behind the link is replaced.
std::string real_path(const std::string& path) {
  char* resolved = realpath(path.c_str(), nullptr);
  std::string out = resolved != nullptr ? resolved : path;
  std::free(resolved);
  return out;
}

/// False for devices and FIFOs, and for /dev/stdout and the like, which lead to an open file.
bool can_be_replaced(const std::string& path, const struct stat& status) {
  return S_ISREG(status.st_mode) && !path.starts_with("/dev/") && !path.starts_with("/proc/");
}

Error system_error(const std::string& path, int code) {
  return {ErrorKind::kFile, path + ": " + std::strerror(code)};
}

}  // namespace

PendingFile::~PendingFile() {
  if (unfinished_) unlink(work_path_.c_str());
}

Result<void> PendingFile::begin(const std::string& path, bool replace) {
  struct stat status {};
  const bool exists = stat(path.c_str(), &status) == 0;
  work_path_ = final_path_ = path;
  if (exists && S_ISDIR(status.st_mode)) return system_error(path, EISDIR);
  if (exists && !can_be_replaced(path, status)) return {};
  if (exists && !replace) return Error{ErrorKind::kExists, path + ": exists (--force replaces it)"};
  if (exists) final_path_ = real_path(path);
  work_path_ = final_path_ + ".part";
  unfinished_.emplace(work_path_);
  const int fd = ::open(work_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0) {
    const int code = errno;
    unfinished_.reset();
    return system_error(path, code);
  }
  if (exists && fchmod(fd, status.st_mode & 07777) != 0) { /* the new file has the modes of any new file */
  }
  close(fd);
  return {};
}

Result<void> PendingFile::commit() {
  if (!unfinished_) return {};
  if (rename(work_path_.c_str(), final_path_.c_str()) != 0) return system_error(final_path_, errno);
  unfinished_.reset();
  return {};
}

OutputFile::~OutputFile() {
  if (fd_ >= 0) close(fd_);
}

Result<void> OutputFile::open(const std::string& path, bool replace) {
  path_ = path;
  to_stdout_ = path == "-";
  if (to_stdout_) return {};
  if (const auto begun = pending_.begin(path, replace); !begun) return begun;
  fd_ = ::open(pending_.path().c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (fd_ < 0) return system_error(path, errno);
  return {};
}

void OutputFile::write(std::string_view text) {
  if (to_stdout_) {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return;
  }
  buffer_ += text;
  if (buffer_.size() >= kBufferBytes) flush();
}

void OutputFile::flush() {
  for (size_t done = 0; done < buffer_.size() && first_error_ == 0;) {
    const ssize_t written = ::write(fd_, buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) first_error_ = written == 0 ? ENOSPC : errno;
    if (written > 0) done += static_cast<size_t>(written);
  }
  buffer_.clear();
}

Result<void> OutputFile::commit() {
  if (to_stdout_) return flush_standard_output();
  flush();
  if (close(fd_) != 0 && first_error_ == 0) first_error_ = errno;
  fd_ = -1;
  if (first_error_ != 0) return system_error(path_, first_error_);
  return pending_.commit();
}

Result<void> write_whole_file(const std::string& path, std::string_view text, bool replace) {
  OutputFile file;
  if (const auto opened = file.open(path, replace); !opened) return opened;
  file.write(text);
  return file.commit();
}

}  // namespace tilepress
