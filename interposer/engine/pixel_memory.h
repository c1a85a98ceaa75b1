// Pixel memory: room for the pixels of a frame, in huge pages where they are to be had.
#pragma once

#include <cstddef>

namespace tilepress {

/// Mapped, not allocated: the program's allocator is its own affair (Chromium's ends the process when asked
/// for such an alignment).
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
