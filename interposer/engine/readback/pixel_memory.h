// Pixel memory: memory for the pixels of a frame.
#pragma once

#include <cstddef>

namespace tilepress {

/// A mapping, so that the program's allocator stays out of it. Without huge pages: reads into them are no
/// faster, and a virtual machine takes longer to provide them than a program to draw its first frames.
class PixelMemory {
 public:
  PixelMemory() = default;
  PixelMemory(const PixelMemory&) = delete;
  PixelMemory& operator=(const PixelMemory&) = delete;
  ~PixelMemory() { unmap(); }
  /// Returns room for `bytes` bytes with undefined contents, or null without memory. Keeps the memory for
  /// later calls.
  std::byte* reserve(size_t bytes);

 private:
  void unmap();
  std::byte* start_ = nullptr;
  size_t capacity_ = 0;
};

}  // namespace tilepress
