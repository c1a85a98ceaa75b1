// Own thread: the stack is a mapping of the usual size, with a page beneath it that ends an overflow.
#include "interposer/engine/own_thread.h"

#include <signal.h>
#include <sys/mman.h>

#include <cstddef>
#include <utility>

namespace tilepress {
namespace {

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
  (*static_cast<std::function<void()>*>(work))();
  return nullptr;
}

void OwnThread::join() {
  if (!started()) return;
  pthread_join(thread_, nullptr);
  munmap(std::exchange(stack_, nullptr), kStackBytes);
}

}  // namespace tilepress
