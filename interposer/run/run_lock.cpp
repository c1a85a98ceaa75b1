// Run lock: fcntl record locks. Every process that can open the file can test them.
#include "tilepress/run_lock.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

namespace tilepress {
namespace {

constexpr off_t kWriterByte = 0, kProgramByte = 1;
constexpr int kPauseMs = 5, kGraceMs = 1000, kPatienceMs = 60'000;

struct flock range_of(short type, off_t first, off_t length) {
  struct flock range {};
  range.l_type = type;
  range.l_whence = SEEK_SET;
  range.l_start = first;
  range.l_len = length;
  return range;
}

bool is_locked(const std::string& path, off_t byte) {
  const int file = open((path + "/frames.csv").c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  struct flock range = range_of(F_WRLCK, byte, 1);
  const bool locked = fcntl(file, F_GETLK, &range) == 0 && range.l_type != F_UNLCK;
  close(file);
  return locked;
}

/// Grows with every row that the writer finishes.
off_t rows_of(const std::string& path) {
  struct stat frames {
  }, schemes{};
  stat((path + "/frames.csv").c_str(), &frames);
  stat((path + "/schemes.csv").c_str(), &schemes);
  return frames.st_size + schemes.st_size;
}

}  // namespace

bool hold_run_lock(int frames_csv) {
  const struct flock range = range_of(F_WRLCK, kWriterByte, kProgramByte - kWriterByte + 1);
  return fcntl(frames_csv, F_SETLK, &range) == 0;
}

void release_program_lock(int frames_csv) {
  const struct flock range = range_of(F_UNLCK, kProgramByte, 1);
  fcntl(frames_csv, F_SETLK, &range);
}

bool run_is_written(const std::string& path) {
  return is_locked(path, kWriterByte);
}

bool program_is_captured(const std::string& path) {
  return is_locked(path, kProgramByte);
}

bool wait_for_writer(const std::string& path, bool program_ended) {
  constexpr timespec kPause{0, kPauseMs * 1'000'000};
  off_t rows = -1;
  for (int waited_ms = 0; run_is_written(path); waited_ms += kPauseMs) {
    program_ended = program_ended || !program_is_captured(path);
    if (waited_ms >= (program_ended ? kPatienceMs : kGraceMs)) return false;
    nanosleep(&kPause, nullptr);
    if (const off_t now = rows_of(path); program_ended && now != rows) {
      rows = now;
      waited_ms = 0;
    }
  }
  return true;
}

}  // namespace tilepress
