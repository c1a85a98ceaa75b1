// Pixel memory: an anonymous mapping, cut down to start on a boundary of huge pages.
#include "interposer/engine/pixel_memory.h"

#include <errno.h>
#include <sys/mman.h>

#include <cstdint>

namespace tilepress {
namespace {

constexpr size_t kPage = 4096, kHugePage = size_t{2} << 20;

size_t round_up(size_t bytes, size_t unit) {
  return (bytes + unit - 1) / unit * unit;
}

std::byte* map(size_t bytes) {
  void* found = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return found != MAP_FAILED ? static_cast<std::byte*>(found) : nullptr;
}

}  // namespace

std::byte* PixelMemory::reserve(size_t bytes) {
  if (bytes <= capacity_ && start_ != nullptr) return start_;
  unmap();
  const bool huge = bytes >= kHugePage / 2;
  const size_t room = round_up(bytes > 0 ? bytes : 1, huge ? kHugePage : kPage);
  start_ = map(huge ? room + kHugePage : room);
  if (start_ == nullptr) return nullptr;
  capacity_ = room;
  if (!huge) return start_;
  const size_t before =
      round_up(reinterpret_cast<uintptr_t>(start_), kHugePage) - reinterpret_cast<uintptr_t>(start_);
  if (before > 0) munmap(start_, before);
  munmap(start_ + before + room, kHugePage - before);
  start_ += before;
  const int saved = errno;
  madvise(start_, room, MADV_HUGEPAGE);  // a wish
  errno = saved;
  return start_;
}

void PixelMemory::unmap() {
  if (start_ != nullptr) munmap(start_, capacity_);
  start_ = nullptr;
  capacity_ = 0;
}

}  // namespace tilepress
