// Append file: O_APPEND, one write per record where the system allows.
#include "tilepress/append_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "run/descriptors.h"
#include "tilepress/file_error.h"
#include "tilepress/run_lock.h"

namespace tilepress {

constexpr int kLowestDescriptor = 200;

/// Opens the file with a high number where the process may have one.
static int open_high(const std::string& path, int flags) {
  return open_above_streams(path, flags | O_WRONLY | O_APPEND, 0644, kLowestDescriptor);
}

AppendFile::~AppendFile() {
  if (is_open() && is_this_file()) close(fd_);
}

bool AppendFile::is_this_file() const {
  struct stat status;
  return fstat(fd_, &status) == 0 && status.st_dev == device_ && status.st_ino == inode_;
}

Result<void> AppendFile::create(const std::string& path, const std::string& header) {
  path_ = path;
  fd_ = open_high(path, O_CREAT | O_EXCL);
  if (fd_ < 0) return file_error(path);
  struct stat status;
  Result<void> begun = fstat(fd_, &status) == 0 ? Result<void>() : file_error(path);
  if (begun) {
    device_ = status.st_dev;
    inode_ = status.st_ino;
    begun = append(header);
  }
  if (begun) return {};
  close(fd_);
  fd_ = -1;
  unlink(path.c_str());
  return begun;
}

void AppendFile::hold_lock() {
  holds_lock_ = true;
  if (is_open()) hold_run_lock(fd_);
}

void AppendFile::release_lock_of_program() {
  if (is_open() && is_this_file()) release_program_lock(fd_);
}

Result<void> AppendFile::open_again() {
  fd_ = open_high(path_, 0);
  if (fd_ < 0) return file_error(path_);
  if (!is_this_file()) {
    close(fd_);
    fd_ = -1;
    return file_error(path_, EBADF);
  }
  if (holds_lock_) hold_run_lock(fd_);
  return {};
}

Result<void> AppendFile::append(const std::string& record) {
  if (!is_this_file())
    if (auto opened = open_again(); !opened) return opened;
  const off_t before = lseek(fd_, 0, SEEK_END);
  size_t done = 0;
  while (done < record.size()) {
    const ssize_t written = write(fd_, record.data() + done, record.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int error = written == 0 ? ENOSPC : errno;
      if (done > 0 && before >= 0 && ftruncate(fd_, before) != 0) { /* the reader drops a torn row */
      }
      return file_error(path_, error);
    }
    done += static_cast<size_t>(written);
  }
  return {};
}

}  // namespace tilepress
