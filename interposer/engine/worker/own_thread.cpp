// Own thread: the stack is a mapping of the usual size above a guard page.
#include "interposer/engine/worker/own_thread.h"

#include <signal.h>
#include <sys/mman.h>

#include <cstddef>
#include <utility>

#if !defined(__SANITIZE_THREAD__)
// A program of the thread sanitizer defines these. The sanitizer does not see how the driver's threads
// synchronize, and would report our calls into the driver as races.
extern "C" {
[[gnu::weak]] void AnnotateIgnoreReadsBegin(const char* file, int line);
[[gnu::weak]] void AnnotateIgnoreReadsEnd(const char* file, int line);
[[gnu::weak]] void AnnotateIgnoreWritesBegin(const char* file, int line);
[[gnu::weak]] void AnnotateIgnoreWritesEnd(const char* file, int line);
}
#endif

namespace tilepress {
namespace {

/// While an object lives, the program's thread sanitizer ignores this thread.
struct IgnoredRaces {
#if !defined(__SANITIZE_THREAD__)
  IgnoredRaces() {
    if (AnnotateIgnoreReadsBegin != nullptr) AnnotateIgnoreReadsBegin(__FILE__, __LINE__);
    if (AnnotateIgnoreWritesBegin != nullptr) AnnotateIgnoreWritesBegin(__FILE__, __LINE__);
  }
  ~IgnoredRaces() {
    if (AnnotateIgnoreReadsEnd != nullptr) AnnotateIgnoreReadsEnd(__FILE__, __LINE__);
    if (AnnotateIgnoreWritesEnd != nullptr) AnnotateIgnoreWritesEnd(__FILE__, __LINE__);
  }
#endif
};

constexpr size_t kStackBytes = size_t{8} << 20, kGuardBytes = size_t{64} << 10;

void* map_stack() {
  void* stack = mmap(nullptr, kStackBytes, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK | MAP_NORESERVE, -1, 0);
  if (stack == MAP_FAILED) return nullptr;
  mprotect(stack, kGuardBytes, PROT_NONE);
  return stack;
}

}  // namespace

bool OwnThread::start(const char* name, std::function<void()> work) {
  void* stack = map_stack();
  if (stack == nullptr) return false;
  work_ = std::move(work);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstack(&attributes, static_cast<std::byte*>(stack) + kGuardBytes, kStackBytes - kGuardBytes);
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  stack_ = stack;
  const bool made = pthread_create(&thread_, &attributes, run, &work_) == 0;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_attr_destroy(&attributes);
  if (made) {
    pthread_setname_np(thread_, name);
    return true;
  }
  munmap(std::exchange(stack_, nullptr), kStackBytes);
  return false;
}

void* OwnThread::run(void* work) {
  [[maybe_unused]] const IgnoredRaces ignored;
  (*static_cast<std::function<void()>*>(work))();
  return nullptr;
}

void OwnThread::join() {
  if (!started()) return;
  pthread_join(thread_, nullptr);
  munmap(std::exchange(stack_, nullptr), kStackBytes);
}

}  // namespace tilepress
