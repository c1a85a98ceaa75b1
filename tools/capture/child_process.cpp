// Child process: fork, exec, pass signals on, wait.
#include "capture/child_process.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "command_line.h"
#include "streams/standard_streams.h"

namespace tilepress {
namespace {

constexpr int kPassedOn[] = {SIGTERM, SIGHUP, SIGUSR1, SIGUSR2};
constexpr int kLeftToChild[] = {SIGINT, SIGQUIT};

volatile sig_atomic_t child_pid = 0;
volatile sig_atomic_t told_to_end = 0;

void pass_on(int signal) {
  const int saved = errno;
  if (child_pid > 0) kill(child_pid, signal);
  if (signal == SIGTERM || signal == SIGHUP) told_to_end = 1;
  errno = saved;
}

bool is_runnable(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && access(path.c_str(), X_OK) == 0;
}

/// The signal handling of the launcher while a child runs; the old one returns with the destructor.
class SignalForwarding {
 public:
  SignalForwarding() {
    sigemptyset(&passed_);
    for (int signal : kPassedOn) sigaddset(&passed_, signal);
    sigprocmask(SIG_BLOCK, &passed_, &old_mask_);  // nothing is passed on before there is a child
    struct sigaction action {};
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    for (int signal : kPassedOn) {
      sigaction(signal, nullptr, &old_[signal]);
      action.sa_handler = pass_on;
      // What the caller ignores (nohup) stays ignored here and in the child.
      if (old_[signal].sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
    }
    action.sa_handler = SIG_IGN;
    for (int signal : kLeftToChild) sigaction(signal, &action, &old_[signal]);
  }
  ~SignalForwarding() {
    child_pid = 0;
    restore();
  }
  void child_started(pid_t pid) {
    child_pid = pid;
    sigprocmask(SIG_SETMASK, &old_mask_, nullptr);
  }
  /// Also called in the child, before exec.
  void restore() {
    for (const auto& [signal, action] : old_) sigaction(signal, &action, nullptr);
    sigprocmask(SIG_SETMASK, &old_mask_, nullptr);
  }

 private:
  sigset_t passed_, old_mask_;
  std::map<int, struct sigaction> old_;
};

[[noreturn]] void exec_child(const std::vector<std::string>& argv,
                             const std::map<std::string, std::string>& environment, int report_fd) {
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> words;
  for (const std::string& word : argv) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  restore_sigpipe();
  execvp(words[0], words.data());
  const int error = errno;
  if (write(report_fd, &error, sizeof error) < 0) _exit(kExitLauncherFailed);
  _exit(kExitNotFound);
}

/// Waits for the end of the child and returns its status as waitpid gives it.
int wait_for(ChildEnd& end, double limit_s) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kGrace = std::chrono::seconds(10);
  constexpr timespec kPause{0, 20'000'000};
  const auto limit =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_s));
  for (int status = 0;;) {
    const pid_t found = waitpid(end.pid, &status, limit_s > 0 ? WNOHANG : 0);
    if (found > 0 || (found < 0 && errno != EINTR)) return status;
    if (limit_s <= 0) continue;
    if (Clock::now() >= limit && !end.ended_by_limit) {
      end.ended_by_limit = true;
      kill(end.pid, SIGTERM);
    }
    if (Clock::now() >= limit + kGrace) kill(end.pid, SIGKILL);
    nanosleep(&kPause, nullptr);
  }
}

}  // namespace

std::optional<std::string> find_program(const std::string& name, StartFailure& failure) {
  if (name.find('/') != std::string::npos) {
    if (is_runnable(name)) return name;
    struct stat status {};
    if (stat(name.c_str(), &status) != 0)
      failure = {errno == EACCES ? kExitNotExecutable : kExitNotFound, name + ": " + std::strerror(errno)};
    else
      failure = {kExitNotExecutable,
                 name + ": " + (S_ISDIR(status.st_mode) ? "is a folder" : "not executable")};
    return std::nullopt;
  }
  const char* variable = std::getenv("PATH");
  const std::string path = variable != nullptr ? variable : "/bin:/usr/bin";
  failure = {kExitNotFound, name + ": not found"};
  for (size_t begin = 0; begin <= path.size() && !name.empty();) {
    const size_t colon = std::min(path.find(':', begin), path.size());
    const std::string folder = path.substr(begin, colon - begin);
    begin = colon + 1;
    const std::string candidate = (folder.empty() ? "." : folder) + "/" + name;
    if (is_runnable(candidate)) return candidate;
    struct stat status {};
    if (stat(candidate.c_str(), &status) == 0 && S_ISREG(status.st_mode))
      failure = {kExitNotExecutable, candidate + ": not executable"};
  }
  return std::nullopt;
}

std::optional<ChildEnd> run_child(const std::vector<std::string>& argv,
                                  const std::map<std::string, std::string>& environment,
                                  StartFailure& failure, double limit_s) {
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0) {
    failure = {kExitLauncherFailed, std::string("pipe: ") + std::strerror(errno)};
    return std::nullopt;
  }
  SignalForwarding signals;
  ChildEnd end;
  end.pid = fork();
  if (end.pid == 0) {
    signals.restore();
    exec_child(argv, environment, report[1]);
  }
  close(report[1]);
  if (end.pid < 0) {
    failure = {kExitLauncherFailed, std::string("fork: ") + std::strerror(errno)};
    close(report[0]);
    return std::nullopt;
  }
  signals.child_started(end.pid);

  int error = 0;
  ssize_t got = 0;
  while ((got = read(report[0], &error, sizeof error)) < 0 && errno == EINTR) {
  }
  close(report[0]);
  const int status = wait_for(end, got == sizeof error ? 0 : limit_s);
  if (got == sizeof error) {
    const bool missing = error == ENOENT || error == ENOTDIR;
    failure = {missing ? kExitNotFound : kExitNotExecutable,
               argv[0] + ": " + (missing ? "its interpreter is missing" : std::strerror(error))};
    return std::nullopt;
  }
  if (WIFSIGNALED(status))
    end.signal = WTERMSIG(status);
  else
    end.exit_status = WEXITSTATUS(status);
  end.told_to_end = told_to_end != 0 || end.signal == SIGINT || end.signal == SIGQUIT;
  return end;
}

}  // namespace tilepress
