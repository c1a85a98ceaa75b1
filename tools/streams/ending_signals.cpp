// Ending signals: handlers that use async-signal-safe functions only.
#include "streams/ending_signals.h"

#include <limits.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "streams/standard_streams.h"

namespace tilepress {
namespace {

/// Signals closer than this are one request: timeout(1) sends each signal twice.
constexpr int64_t kSameRequestNs = 250'000'000;

std::atomic<int> noted{0};
int64_t noted_at_ns = 0;
pid_t owner = 0;

struct Slot {
  std::atomic<int> state{0};  ///< 0 free, 1 being filled, 2 names a file
  char path[PATH_MAX];
};
Slot slots[8];

/// What a signal prints. The handler itself must not format text.
struct LastLine {
  int signal;
  char text[80];
};
LastLine last_lines[] = {{SIGINT, ""}, {SIGTERM, ""}, {SIGHUP, ""}};

int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

void die_of(int signal) {
  ::signal(signal, SIG_DFL);
  raise(signal);  // delivered when the handler returns
}

void end_at_once(int signal) {
  if (getpid() != owner) return die_of(signal);  // a child between fork and exec
  for (Slot& slot : slots)
    if (slot.state == 2) unlink(slot.path);
  for (const LastLine& last : last_lines)
    if (last.signal == signal && write(true_standard_error(), last.text, std::strlen(last.text)) < 0) break;
  _exit(128 + signal);
}

void note(int signal) {
  const int saved = errno;
  if (noted == 0) {
    noted_at_ns = now_ns();
    noted = signal;
    // The verb may enter a blocking call just after it has looked at `noted`: wake it up again and again.
    constexpr itimerval kAgainAndAgain = {{0, 50'000}, {0, 50'000}};
    setitimer(ITIMER_REAL, &kAgainAndAgain, nullptr);
  } else if (now_ns() - noted_at_ns > kSameRequestNs) {
    die_of(signal);
  }
  errno = saved;
}

}  // namespace

void choose_on_signal(OnSignal choice) {
  if (choice == OnSignal::kVerbsOwn) return;
  owner = getpid();
  struct sigaction action {};
  sigemptyset(&action.sa_mask);
  for (const LastLine& last : last_lines) sigaddset(&action.sa_mask, last.signal);
  // Without SA_RESTART, so that a verb that waits for input looks at `noted`.
  action.sa_handler = [](int) {};
  if (choice == OnSignal::kEndInOrder) sigaction(SIGALRM, &action, nullptr);
  action.sa_handler = choice == OnSignal::kEndInOrder ? note : end_at_once;
  for (LastLine& last : last_lines) {
    std::snprintf(last.text, sizeof last.text, "tilepress: %s\n", signal_text(last.signal).c_str());
    struct sigaction old {};
    sigaction(last.signal, nullptr, &old);
    if (old.sa_handler != SIG_IGN) sigaction(last.signal, &action, nullptr);
  }
}

const std::atomic<int>& noted_signal() {
  return noted;
}

std::string state_after(int signal) {
  return "killed by signal " + std::to_string(signal);
}

std::string signal_text(int signal) {
  return state_after(signal) + " (" + strsignal(signal) + ")";
}

UnfinishedFile::UnfinishedFile(const std::string& path) {
  if (path.size() >= sizeof Slot::path) return;
  for (size_t i = 0; i < std::size(slots); ++i) {
    int free = 0;
    if (!slots[i].state.compare_exchange_strong(free, 1)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].state = 2;
    slot_ = i;
    return;
  }
}

UnfinishedFile::~UnfinishedFile() {
  if (slot_ != kNone) slots[slot_].state = 0;
}

}  // namespace tilepress
