// Append file: O_APPEND, one write per record where the system allows.
#include "run/append_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "run/descriptors.h"
#include "tilepress/run_lock.h"

namespace tilepress {
namespace {

constexpr int kLowestDescriptor = 200;

/// Opens with a high number if the process may have one.
int open_high(const std::string& path, int flags) {
  return open_above_streams(path, flags | O_WRONLY | O_APPEND, 0644, kLowestDescriptor);
}

}  // namespace

AppendFile::~AppendFile() {
  if (is_open() && is_this_file()) close(fd_);
}

bool AppendFile::is_this_file() const {
  struct stat status;
  return fstat(fd_, &status) == 0 && status.st_dev == device_ && status.st_ino == inode_;
}

bool AppendFile::create(const std::string& path, const std::string& header) {
  path_ = path;
  fd_ = open_high(path, O_CREAT | O_EXCL);
  if (fd_ < 0) return false;
  struct stat status;
  if (fstat(fd_, &status) == 0) {
    device_ = status.st_dev;
    inode_ = status.st_ino;
    if (append(header)) return true;
  }
  const int error = errno;
  close(fd_);
  fd_ = -1;
  unlink(path.c_str());
  errno = error;
  return false;
}

void AppendFile::hold_lock() {
  holds_lock_ = true;
  if (is_open()) hold_run_lock(fd_);
}

void AppendFile::release_lock_of_program() {
  if (is_open() && is_this_file()) release_program_lock(fd_);
}

bool AppendFile::append(const std::string& record) {
  if (!is_this_file()) {
    fd_ = open_high(path_, 0);
    if (fd_ < 0 || !is_this_file()) {
      if (fd_ >= 0) close(fd_);
      fd_ = -1;
      errno = EBADF;
      return false;
    }
    if (holds_lock_) hold_run_lock(fd_);
  }
  const off_t before = lseek(fd_, 0, SEEK_END);
  size_t done = 0;
  while (done < record.size()) {
    const ssize_t written = write(fd_, record.data() + done, record.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int error = written == 0 ? ENOSPC : errno;
      if (done > 0 && before >= 0 && ftruncate(fd_, before) != 0) { /* the reader drops a torn row */
      }
      errno = error;
      return false;
    }
    done += static_cast<size_t>(written);
  }
  return true;
}

}  // namespace tilepress
