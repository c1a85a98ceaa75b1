// Shared file: plain files in the run directory, so that everyone who can read the run can watch it.
#include "run/shared_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "run/descriptors.h"

namespace tilepress {

void* create_shared_file(const std::string& path, size_t bytes) {
  const int file = open_above_streams(path, O_RDWR | O_CREAT | O_EXCL, 0644);
  if (file < 0) return nullptr;
  // Not ftruncate: on a full disk, the first store into a hole would end the program with SIGBUS.
  int error = posix_fallocate(file, 0, static_cast<off_t>(bytes));
  void* memory = MAP_FAILED;
  if (error == 0) {
    memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (memory == MAP_FAILED) error = errno;
  }
  close(file);
  if (memory != MAP_FAILED) return memory;
  unlink(path.c_str());
  errno = error;
  return nullptr;
}

void* map_shared_file(const std::string& path, size_t least_bytes, bool writable, size_t& bytes) {
  const int file = open(path.c_str(), (writable ? O_RDWR : O_RDONLY) | O_CLOEXEC);
  if (file < 0) return nullptr;
  struct stat status {};
  void* memory = MAP_FAILED;
  errno = 0;
  if (fstat(file, &status) == 0 && status.st_size >= static_cast<off_t>(least_bytes)) {
    bytes = static_cast<size_t>(status.st_size);
    memory = mmap(nullptr, bytes, writable ? PROT_READ | PROT_WRITE : PROT_READ, MAP_SHARED, file, 0);
  }
  const int error = errno;
  close(file);
  errno = error;
  return memory == MAP_FAILED ? nullptr : memory;
}

}  // namespace tilepress
