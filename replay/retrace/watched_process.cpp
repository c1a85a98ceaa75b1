// Watched process: fork, exec, pipes.
#include "watched_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

extern char** environ;

namespace tilepress {
namespace {

constexpr int kExecFailed = 127;
constexpr std::chrono::seconds kGrace{1};

/// Our environment with `changes` applied, for execve.
struct Environment {
  explicit Environment(const std::map<std::string, std::string>& changes) {
    for (char** entry = environ; *entry != nullptr; ++entry) {
      const std::string_view text(*entry);
      if (!changes.contains(std::string(text.substr(0, text.find('='))))) strings.emplace_back(text);
    }
    for (const auto& [name, value] : changes)
      if (!value.empty()) strings.push_back(name + "=" + value);
    for (std::string& text : strings) pointers.push_back(text.data());
    pointers.push_back(nullptr);
  }
  std::vector<std::string> strings;
  std::vector<char*> pointers;
};

/// Runs in the child of a program with threads: system calls only.
[[noreturn]] void become(char* const* argv, char* const* environment, pid_t parent, const int (&fds)[3],
                         int report_fd, int kept_fd) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kExecFailed);
  for (int i = 0; i < 3; ++i) dup2(fds[i], i);
  if (kept_fd >= 0) fcntl(kept_fd, F_SETFD, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int ignored : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(ignored, SIG_DFL);
  execve(argv[0], argv, environment);
  const int error = errno;
  if (write(report_fd, &error, sizeof error) < 0) _exit(kExecFailed);
  _exit(kExecFailed);
}

void close_all(std::initializer_list<int> fds) {
  for (const int fd : fds)
    if (fd >= 0) close(fd);
}

}  // namespace

void LastLines::add(const char* bytes, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    if (bytes[i] == '\n' || bytes[i] == '\r') {
      open_ = false;
      continue;
    }
    if (!open_) {
      lines_.emplace_back();
      if (lines_.size() > kMaxLines) lines_.pop_front();
      open_ = true;
    }
    if (lines_.back().size() < kMaxLineBytes) lines_.back() += bytes[i];
  }
}

WatchedProcess::~WatchedProcess() {
  end();
  close_all({errors_fd_});
}

Result<void> WatchedProcess::start(const std::vector<std::string>& argv,
                                   const std::map<std::string, std::string>& environment, int kept_fd) {
  const Environment variables(environment);
  std::vector<char*> words;
  for (const std::string& word : argv) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);

  int errors[2] = {-1, -1}, report[2] = {-1, -1};
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  bool good = nothing >= 0 && pipe2(errors, O_CLOEXEC) == 0 && pipe2(report, O_CLOEXEC) == 0;
  const pid_t parent = getpid();
  if (good) pid_ = fork();
  if (good && pid_ == 0)
    become(words.data(), variables.pointers.data(), parent, {nothing, nothing, errors[1]}, report[1],
           kept_fd);
  int failure = errno;
  close_all({nothing, errors[1], report[1]});
  if (!good || pid_ < 0) {
    close_all({errors[0], report[0]});
    return Error{ErrorKind::kSystem, argv[0] + ": " + std::strerror(failure)};
  }
  setpgid(pid_, pid_);  // in both processes: the group exists for both from now on
  ssize_t got = 0;
  while ((got = read(report[0], &failure, sizeof failure)) < 0 && errno == EINTR) {
  }
  close(report[0]);
  errors_fd_ = errors[0];
  fcntl(errors_fd_, F_SETFL, O_NONBLOCK);
  if (got != sizeof failure) return {};
  reap(0);
  return Error{ErrorKind::kSystem, argv[0] + ": " + std::strerror(failure)};
}

void WatchedProcess::read_errors() {
  char buffer[4096];
  ssize_t got = 0;
  while (errors_fd_ >= 0 && (got = read(errors_fd_, buffer, sizeof buffer)) > 0)
    errors_.add(buffer, static_cast<size_t>(got));
  if (errors_fd_ < 0 || (got < 0 && (errno == EAGAIN || errno == EINTR))) return;
  close(errors_fd_);
  errors_fd_ = -1;
}

bool WatchedProcess::reap(int flags) {
  if (!running()) return true;
  int status = 0;
  pid_t got = 0;
  while ((got = waitpid(pid_, &status, flags)) < 0 && errno == EINTR) {
  }
  if (got == 0) return false;
  ended_ = true;
  if (got == pid_ && WIFSIGNALED(status))
    signal_ = WTERMSIG(status);
  else
    exit_status_ = got == pid_ ? WEXITSTATUS(status) : kExecFailed;
  return true;
}

bool WatchedProcess::wait(std::chrono::milliseconds time) {
  const auto until = std::chrono::steady_clock::now() + time;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    // With the stream closed the process is about to end, and no event reports its end.
    const int64_t slice = errors_fd_ >= 0 ? left.count() : std::min<int64_t>(left.count(), 5);
    pollfd errors = {errors_fd_, POLLIN, 0};  // poll() only waits for a descriptor of -1
    if (!reap(WNOHANG)) poll(&errors, 1, static_cast<int>(std::max<int64_t>(0, slice)));
    const bool ended = reap(WNOHANG);  // before the last read, which then gets everything
    read_errors();
    if (ended || left.count() <= 0) return ended;
  }
}

void WatchedProcess::end() {
  if (!running()) return;
  kill(-pid_, SIGTERM);
  const bool ended = wait(kGrace);
  kill(-pid_, SIGKILL);  // the rest of the group too
  if (!ended) reap(0);
}

}  // namespace tilepress
