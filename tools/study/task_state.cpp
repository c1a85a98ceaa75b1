// Task state: locks of open file descriptions.
#include "task_state.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "study/cache/host_name.h"
#include "tilepress/file_error.h"
#include "tilepress/whole_file.h"

namespace tilepress {

namespace {

std::string path_of(const std::string& folder, const std::string& task, const char* ending) {
  return folder + "/tasks/" + task + ending;
}

struct flock whole_file_lock() {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

TaskLock::~TaskLock() {
  if (fd_ < 0) return;
  // While the lock is held: whoever waits for this file finds all results afterwards.
  unlink(path_.c_str());
  close(fd_);
}

Result<bool> TaskLock::take(const std::string& folder, const std::string& task) {
  path_ = path_of(folder, task, ".lock");
  std::error_code code;
  std::filesystem::create_directories(folder + "/tasks", code);
  const int fd = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (fd < 0) return file_error(path_);
  struct flock lock = whole_file_lock();
  if (fcntl(fd, F_OFD_SETLK, &lock) != 0) {
    const int error = errno;
    close(fd);
    if (error == EAGAIN || error == EACCES) return false;
    return file_error(path_, error);
  }
  fd_ = fd;
  const std::string owner = host_name() + ", process " + std::to_string(getpid()) + "\n";
  if (ftruncate(fd_, 0) != 0 || write(fd_, owner.data(), owner.size()) < 0) { /* only the name is missing */
  }
  return true;
}

std::string rendering_lock(const std::string& workload) {
  return workload + ".frames";
}

std::optional<TaskWorker> worker_of(const std::string& folder, const std::string& task) {
  const std::string path = path_of(folder, task, ".lock");
  const int fd = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (fd < 0) return std::nullopt;
  struct flock lock = whole_file_lock();
  const bool held = fcntl(fd, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(fd);
  const auto text = read_whole_file(path);
  if (!text) return std::nullopt;  // it has ended meanwhile
  return TaskWorker{text->substr(0, text->find('\n')), held};
}

void forget_task(const std::string& folder, const std::string& task) {
  unlink(path_of(folder, task, ".json").c_str());
  const auto worker = worker_of(folder, task);
  if (worker && !worker->alive) unlink(path_of(folder, task, ".lock").c_str());
}

}  // namespace tilepress
