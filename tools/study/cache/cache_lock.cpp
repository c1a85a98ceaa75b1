// Cache lock: the file names host, process and PID namespace.
#include "study/cache/cache_lock.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>

#include "streams/ending_signals.h"
#include "study/cache/file_bytes.h"
#include "study/cache/host_name.h"
#include "tilepress/file_error.h"
#include "tilepress/run_folder.h"
#include "tilepress/whole_file.h"

namespace tilepress {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kLookPeriod{100};

/// Empty if the file cannot be read.
std::string text_of(const std::string& path) {
  const auto text = read_whole_file(path);
  return text ? *text : "";
}

/// When a process of this host began, in ticks since the host began. Nothing if there is no such process.
/// Process numbers come again.
std::optional<uint64_t> process_start(int64_t pid) {
  const std::string text = text_of("/proc/" + std::to_string(pid) + "/stat");
  const size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(name_end + 1));
  std::string word;
  for (int field = 3; field < 22; ++field) fields >> word;
  uint64_t start = 0;
  if (!(fields >> start)) return std::nullopt;
  return start;
}

std::string own_mark() {
  return host_name() + "\n" + std::to_string(getpid()) + "\n" + std::to_string(own_pid_namespace()) + "\n" +
         std::to_string(process_start(getpid()).value_or(0)) + "\n";
}

bool is_of_dead_process(const std::string& mark) {
  std::istringstream lines(mark);
  std::string host;
  int64_t pid = 0;
  uint64_t space = 0, start = 0;
  if (!std::getline(lines, host) || !(lines >> pid >> space >> start)) return false;
  if (host != host_name() || space != own_pid_namespace() || space == 0) return false;
  return process_start(pid).value_or(0) != start;
}

int64_t touched_ns(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return 0;
  return status.st_mtim.tv_sec * 1'000'000'000 + status.st_mtim.tv_nsec;
}

/// Removes the lock with this mark. Another process may do so at the same time, and a third one may have made
/// its own lock since: that one is put back.
void remove_stale(const std::string& path, const std::string& mark) {
  const std::string aside = path + "-stale-" + host_name() + "-" + std::to_string(getpid());
  if (rename(path.c_str(), aside.c_str()) != 0) return;
  if (text_of(aside) != mark &&
      link(aside.c_str(), path.c_str()) != 0) { /* then two render the same frames */
  }
  unlink(aside.c_str());
}

}  // namespace

struct CacheLock::State {
  std::string path;
  std::optional<UnfinishedFile> unfinished;
  std::mutex mutex;
  std::condition_variable ended;
  bool ending = false;
  std::thread toucher;

  explicit State(std::string lock_path) : path(std::move(lock_path)), unfinished(path) {
    toucher = std::thread([this] {
      for (std::unique_lock lock(mutex); !ended.wait_for(lock, kTouchPeriod, [this] { return ending; });)
        utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
    });
  }
  ~State() {
    {
      const std::lock_guard lock(mutex);
      ending = true;
    }
    ended.notify_one();
    toucher.join();
    unlink(path.c_str());
  }
};

CacheLock::CacheLock() = default;
CacheLock::~CacheLock() = default;

Result<bool> CacheLock::take(const std::string& path, const std::function<bool()>& given_up) {
  const std::string own = own_mark();
  std::string seen;
  int64_t seen_touched = -1;
  Clock::time_point since = Clock::now();
  for (;;) {
    const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd >= 0) {
      state_ = std::make_unique<State>(path);
      const bool written = write_at(fd, 0, bytes_of(own));
      const Error error = file_error(path);
      close(fd);
      if (written) return true;
      state_.reset();
      return error;
    }
    if (errno != EEXIST) return file_error(path);
    const std::string mark = text_of(path);
    const int64_t touched = touched_ns(path);
    if (mark != seen || touched != seen_touched) since = Clock::now();
    seen = mark;
    seen_touched = touched;
    if (is_of_dead_process(mark) || Clock::now() - since > kStaleLock) {
      remove_stale(path, mark);
      continue;
    }
    if (given_up()) return false;
    std::this_thread::sleep_for(kLookPeriod);
  }
}

bool is_lock_of_dead_process(const std::string& path) {
  return is_of_dead_process(text_of(path));
}

}  // namespace tilepress
