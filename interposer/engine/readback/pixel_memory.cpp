// Pixel memory: an anonymous mapping.
#include "interposer/engine/readback/pixel_memory.h"

#include <sys/mman.h>

#include <algorithm>

namespace tilepress {

std::byte* PixelMemory::reserve(size_t bytes) {
  if (bytes <= capacity_ && start_ != nullptr) return start_;
  unmap();
  const size_t room = std::max<size_t>(bytes, 1);
  void* found = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (found == MAP_FAILED) return nullptr;
  start_ = static_cast<std::byte*>(found);
  capacity_ = room;
  return start_;
}

void PixelMemory::unmap() {
  if (start_ != nullptr) munmap(start_, capacity_);
  start_ = nullptr;
  capacity_ = 0;
}

}  // namespace tilepress
