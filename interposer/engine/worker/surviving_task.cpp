// Surviving task: clone without CLONE_THREAD, through system calls that no library replaces.
#include "interposer/engine/worker/surviving_task.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/time.h>

#include <atomic>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "interposer/system_calls.h"

namespace tilepress {

/// The assembly reads it, so the order of the members is fixed.
struct TaskStart {
  void (*work)(void* argument);
  void* argument;
  void* parking_stack;  ///< its upper end
  uint64_t signals;     ///< mask of the thread while it waits
};
static_assert(offsetof(TaskStart, parking_stack) == 16 && offsetof(TaskStart, signals) == 24);

#if defined(__x86_64__) || defined(__aarch64__)
extern "C" long tilepress_clone_task(const TaskStart* start, unsigned long flags);
#else
extern "C" long tilepress_clone_task(const TaskStart*, unsigned long) {
  return -ENOSYS;
}
#endif
#if defined(__x86_64__)
extern "C" void tilepress_signal_return();
#endif

namespace {

constexpr size_t kParkingBytes = size_t{64} << 10;
constexpr long kSignalBytes = sizeof(uint64_t);
constexpr long kWatchdogSeconds = 30;
// Hides the task from a tracer: a debugger would take it for a thread of the program.
constexpr unsigned long kCloneFlags = CLONE_VM | CLONE_UNTRACED;

std::atomic<bool> ended_by_signal{false};  ///< the kernel has sent the signal of the program's end

/// The kernel's sigaction, which differs from the C library's.
struct KernelSignalAction {
  void (*handler)(int);
  unsigned long flags;
  void (*restorer)();
  uint64_t mask;
};

void arm_watchdog() {
  const itimerval limit = {{0, 0}, {kWatchdogSeconds, 0}};
  system_call(SYS_setitimer, ITIMER_REAL, address_of(&limit));
}

void on_program_end(int) {
  ended_by_signal.store(true, std::memory_order_relaxed);
  arm_watchdog();
}

void set_action(int signal, void (*handler)(int)) {
  KernelSignalAction action = {handler, SA_RESTART, nullptr, 0};
#if defined(__x86_64__)
  constexpr unsigned long kRestorer = 0x04000000;  // SA_RESTORER
  action.flags |= kRestorer;
  action.restorer = tilepress_signal_return;
#endif
  system_call(SYS_rt_sigaction, signal, address_of(&action), 0, kSignalBytes);
}

// The kernel sends the signal when the thread that made the task ends, and again for each thread of the
// program that is the task's parent in turn.
void handle_program_end() {
  constexpr int kProgramEnd = SIGUSR1;
  set_action(kProgramEnd, on_program_end);
  set_action(SIGALRM, SIG_DFL);  // the watchdog's
  const uint64_t heeded = uint64_t{1} << (kProgramEnd - 1) | uint64_t{1} << (SIGALRM - 1);
  system_call(SYS_rt_sigprocmask, SIG_UNBLOCK, address_of(&heeded), 0, kSignalBytes);
  system_call(SYS_prctl, PR_SET_PDEATHSIG, kProgramEnd);
}

/// The table is a copy. No pipe or socket of the program may stay open because of the copy.
void close_descriptors() {
  constexpr long kCloseRange = 436;
  constexpr int kLikely = 1 << 16;
  if (system_call(kCloseRange, 0, UINT_MAX) < 0)
    for (int file = 0; file < kLikely; ++file) system_call(SYS_close, file);
  // No file of ours may get the number of a standard stream.
  const long nowhere = system_call(SYS_openat, AT_FDCWD, address_of("/dev/null"), O_RDWR);
  if (nowhere < 0) return;
  system_call(SYS_dup3, nowhere, 1, 0);
  system_call(SYS_dup3, nowhere, 2, 0);
}

/// Allocators keep memory per processor and learn the thread's processor from the kernel (rseq). The
/// registration moves with the thread-local memory: from the thread to the task, and back.
class RestartableSequences {
 public:
  RestartableSequences() {
    const auto* offset = static_cast<const ptrdiff_t*>(dlsym(RTLD_DEFAULT, "__rseq_offset"));
    const auto* size = static_cast<const unsigned*>(dlsym(RTLD_DEFAULT, "__rseq_size"));
    if (offset == nullptr || size == nullptr || *size == 0) return;
    area_ = static_cast<char*>(__builtin_thread_pointer()) + *offset;
    constexpr long kUnregister = 1;
    if (call(kUnregister) != 0) area_ = nullptr;
  }
  void enter() const {
    if (area_ != nullptr) call(0);
  }

 private:
#if defined(__aarch64__)
  static constexpr long kSignature = 0xd428bc00;
#else
  static constexpr long kSignature = 0x53053053;
#endif
  static constexpr long kNumber =
#ifdef SYS_rseq
      SYS_rseq;
#else
      -1;
#endif
  static constexpr long kBytes = 32;
  long call(long flags) const {
    return system_call(kNumber, address_of(area_), kBytes, flags, kSignature);
  }
  char* area_ = nullptr;
};

/// Returns null if a task may be tried.
const char* known_obstacle() {
  // A sandbox may kill a process for an unknown kind of clone.
  if (system_call(SYS_prctl, PR_GET_SECCOMP) != 0) return "a seccomp filter is installed";
  // Valgrind does not support such a task. It preloads a library of its own into every program.
  const char* preloaded = std::getenv("LD_PRELOAD");
  if (preloaded != nullptr && std::strstr(preloaded, "/vgpreload_") != nullptr) return "under Valgrind";
  return nullptr;
}

}  // namespace

void SurvivingTask::enter() {
  in_task_ = true;
  close_descriptors();
  system_call(SYS_setsid);  // what ends or stops the program's process group is not meant for this task
  handle_program_end();
  system_call(SYS_prctl, PR_SET_NAME, address_of("tilepress"));
}

void SurvivingTask::run(const std::function<void()>& work) {
  obstacle_ = known_obstacle();
  void* parking = obstacle_ != nullptr ? MAP_FAILED
                                       : mmap(nullptr, kParkingBytes, PROT_READ | PROT_WRITE,
                                              MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (parking == MAP_FAILED) return work();
  program_ = static_cast<int>(system_call(SYS_getpid));
  thread_ = static_cast<int>(system_call(SYS_gettid));
  ended_by_signal = false;
  uint64_t before = 0;
  const uint64_t all = ~uint64_t{0};
  // The C library's own signals as well: no handler may run while two have one stack.
  system_call(SYS_rt_sigprocmask, SIG_SETMASK, address_of(&all), address_of(&before), kSignalBytes);
  const RestartableSequences sequences;
  struct Entry {
    SurvivingTask* task;
    const std::function<void()>* work;
    const RestartableSequences* sequences;
  } entry = {this, &work, &sequences};
  TaskStart start = {};
  start.work = [](void* argument) {
    const Entry& own = *static_cast<Entry*>(argument);
    own.sequences->enter();
    own.task->enter();
    (*own.work)();
  };
  start.argument = &entry;
  start.parking_stack = static_cast<std::byte*>(parking) + kParkingBytes;
  start.signals = before;
  const long result = tilepress_clone_task(&start, kCloneFlags);
  sequences.enter();
  system_call(SYS_rt_sigprocmask, SIG_SETMASK, address_of(&before), 0, kSignalBytes);
  munmap(parking, kParkingBytes);
  in_task_ = false;
  if (result == 0) return;
  obstacle_ = "the system refuses one";
  work();
}

bool SurvivingTask::program_gone() const {
  if (!in_task_) return false;
  // The signal does not come if the program has dropped privileges since.
  return ended_by_signal.load(std::memory_order_relaxed) ||
         system_call(SYS_tgkill, program_, thread_, 0) == -ESRCH;
}

void SurvivingTask::note_progress() const {
  if (in_task_ && ended_by_signal.load(std::memory_order_relaxed)) arm_watchdog();
}

}  // namespace tilepress
