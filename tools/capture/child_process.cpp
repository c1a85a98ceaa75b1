// Child process: fork, exec, pass signals on, wait.
#include "capture/child_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "exit_status.h"
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

/// The launcher's signal handling while a child runs. The destructor restores the old handling.
class SignalForwarding {
 public:
  SignalForwarding() {
    sigemptyset(&passed_);
    for (int signal : kPassedOn) sigaddset(&passed_, signal);
    sigprocmask(SIG_BLOCK, &passed_, &old_mask_);  // no signal is passed on before there is a child
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

/// Waits for the end of the child. Returns its status in waitpid's form.
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

Result<ChildEnd> run_child(const std::vector<std::string>& argv,
                           const std::map<std::string, std::string>& environment, double limit_s) {
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0)
    return Error{ErrorKind::kSystem, std::string("pipe: ") + std::strerror(errno)};
  SignalForwarding signals;
  ChildEnd end;
  end.pid = fork();
  if (end.pid == 0) {
    signals.restore();
    exec_child(argv, environment, report[1]);
  }
  close(report[1]);
  if (end.pid < 0) {
    const int reason = errno;
    close(report[0]);
    return Error{ErrorKind::kSystem, std::string("fork: ") + std::strerror(reason)};
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
    return Error{missing ? ErrorKind::kFile : ErrorKind::kUnsupported,
                 argv[0] + ": " + (missing ? "its interpreter is missing" : std::strerror(error))};
  }
  if (WIFSIGNALED(status))
    end.signal = WTERMSIG(status);
  else
    end.exit_status = WEXITSTATUS(status);
  end.told_to_end = told_to_end != 0 || end.signal == SIGINT || end.signal == SIGQUIT;
  return end;
}

int start_status(const Error& error) {
  if (error.kind == ErrorKind::kFile) return kExitNotFound;
  return error.kind == ErrorKind::kUnsupported ? kExitNotExecutable : kExitLauncherFailed;
}

}  // namespace tilepress
