// Pixel memory: room for the pixels of a frame.
#pragma once

#include <cstddef>

namespace tilepress {

/// Mapped, not allocated: the program's allocator is its own affair. Huge pages are not asked for: frames are
/// read into them no faster, and to get some takes a virtual machine longer than a program's first frames do.
class PixelMemory {
 public:
  PixelMemory() = default;
  PixelMemory(const PixelMemory&) = delete;
  PixelMemory& operator=(const PixelMemory&) = delete;
  ~PixelMemory() { unmap(); }
  /// Room for `bytes` bytes, contents undefined, kept until more is asked for; null if there is no memory.
  std::byte* reserve(size_t bytes);

 private:
  void unmap();
  std::byte* start_ = nullptr;
  size_t capacity_ = 0;
};

}  // namespace tilepress
