// Captured frame: the pixels of one presented frame on their way from the program's thread to the worker.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "interposer/engine/readback/pixel_buffers.h"
#include "interposer/engine/surface_registry.h"
#include "tilepress/result.h"
#include "tilepress/surface.h"

namespace tilepress {

/// How a frame is read. The read policy sets the wanted way, and the source the way taken.
enum class ReadWay : uint8_t {
  kSync,       ///< into the frame's own memory, in the call
  kAsync,      ///< into a pixel buffer; the pixels follow
  kBoth,       ///< synchronously, and into a pixel buffer too for the time it takes
  kInContext,  ///< synchronously, in the program's own context
};

/// Why a frame cannot be read.
inline Error unreadable(const char* text) {
  return {ErrorKind::kUnsupported, text};
}

/// Memory for the pixels of a frame. A mapping, so that the program's allocator stays out of it. Without huge
/// pages: reads into them are no faster, and a virtual machine takes longer to provide them than a program to
/// draw its first frames.
class PixelMemory {
 public:
  PixelMemory() = default;
  PixelMemory(const PixelMemory&) = delete;
  PixelMemory& operator=(const PixelMemory&) = delete;
  ~PixelMemory() { unmap(); }
  /// Returns room for `bytes` bytes with undefined contents, or null without memory. Keeps the memory for
  /// later calls.
  std::byte* reserve(size_t bytes) {
    if (bytes <= capacity_ && start_ != nullptr) return start_;
    unmap();
    const size_t room = std::max<size_t>(bytes, 1);
    void* found = mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (found == MAP_FAILED) return nullptr;
    start_ = static_cast<std::byte*>(found);
    capacity_ = room;
    return start_;
  }

 private:
  void unmap() {
    if (start_ != nullptr) munmap(start_, capacity_);
    start_ = nullptr;
    capacity_ = 0;
  }
  std::byte* start_ = nullptr;
  size_t capacity_ = 0;
};

/// Owns its pixels; the memory is kept when the frame is used again.
struct CapturedFrame {
  bool last_of_window = false;  ///< no pixels: the window is gone, and the worker may free its state
  uint32_t window = 0;          ///< number of the program's window, at any size
  uint32_t surface = 0;         ///< number of the window at one size and format, as in the statistics
  uint64_t frame = 0;           ///< number of the frame within its surface
  uint64_t time_ns = 0;         ///< since the run began
  uint64_t readback_ns = 0;     ///< time of the capture on the program's thread, without wait_ns
  uint64_t read_ns = 0;         ///< part of readback_ns: the read, which waits for the rendering to end
  uint64_t wait_ns = 0;         ///< waiting for room in the queue
  uint64_t bind_ns = 0;         ///< part of readback_ns: making a private context current, and back
  uint64_t hand_off_ns = 0;     ///< handing the frame to the worker, after the real call
  uint64_t interval_ns = 0;     ///< since the window's last present; 0 = its first
  SurfaceRole role = SurfaceRole::kPresented;
  const char* cause = "swap";  ///< "swap", "finish", "flush", "readpixels" or "target"
  std::string origin;          ///< what the surface is: "window", "buffer", "texture 3", …
  bool srgb = false;           ///< the values are encoded as sRGB
  std::string damage;          ///< "x y width height;…" from the bottom left; empty = everything

  ReadWay way = ReadWay::kSync;
  bool partial = false;            ///< the buffer may be smaller than the read: the rest must be 0
  uint64_t buffered_ns = 0;        ///< kBoth: time of the read into a pixel buffer; 0 = that is not possible
  std::unique_ptr<LateRead> late;  ///< kAsync, until the frame is posted to the late reader
  std::function<void(bool whole)> arrive;  ///< the late reader calls it once, from any thread

  // The frame queue's, under its lock.
  bool awaited = false;           ///< the pixels have not arrived yet
  bool lost = false;              ///< the pixels will never arrive
  bool unwanted = false;          ///< released before the pixels arrived
  CapturedFrame* next = nullptr;  ///< in the same list

  SurfaceView view;  ///< of pixels_

  /// Returns room for `bytes` bytes with undefined contents, or null without memory.
  std::byte* reserve(size_t bytes) { return pixels_.reserve(bytes); }
  /// The same for the pixels of a surface as GL returns them, without gaps and the last row first. Sets
  /// `view`.
  std::byte* reserve(const SurfaceShape& shape, size_t pixel_bytes, ByteOrder order) {
    const size_t pitch_bytes = shape.width * pixel_bytes;
    std::byte* pixels = reserve(pitch_bytes * shape.height);
    if (pixels == nullptr) return nullptr;
    view = {pixels + pitch_bytes * (shape.height - 1),
            -static_cast<ptrdiff_t>(pitch_bytes),
            shape.width,
            shape.height,
            *shape.format,
            order};
    return pixels;
  }

 private:
  PixelMemory pixels_;
};

}  // namespace tilepress
