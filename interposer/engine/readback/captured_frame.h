// Captured frame: the pixels of one presented frame on their way from the program's thread to the worker.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "interposer/engine/readback/late_read.h"
#include "interposer/engine/readback/pixel_memory.h"
#include "interposer/engine/surface_registry.h"
#include "tilepress/surface.h"

namespace tilepress {

/// How a frame is read. Asked of a source, which notes what came of it.
enum class ReadWay : uint8_t {
  kSync,       ///< into the frame's own memory, in the call
  kAsync,      ///< into a pixel buffer; the pixels follow
  kBoth,       ///< synchronously, and into a pixel buffer too for the time it takes
  kInContext,  ///< synchronously, in the program's own context
};

/// Owns its pixels; the memory is kept when the frame is used again.
struct CapturedFrame {
  bool last_of_window = false;  ///< no pixels: the window is gone, and so may be what is kept for it
  uint32_t window = 0;          ///< which of the program's surfaces, whatever its size
  uint32_t surface = 0;         ///< surface number in the statistics: a window at one size and format
  uint64_t frame = 0;           ///< number of the frame within its surface
  uint64_t time_ns = 0;         ///< since the run began
  uint64_t readback_ns = 0;     ///< all that the program's thread spent, without wait_ns
  uint64_t read_ns = 0;         ///< of that, in the read itself, which waits for the rendering to end
  uint64_t wait_ns = 0;         ///< for room in the queue
  uint64_t bind_ns = 0;      ///< of readback_ns, in making a private context current and the program's again
  uint64_t hand_off_ns = 0;  ///< giving the frame to the worker, after the real call
  uint64_t interval_ns = 0;  ///< since the window's last present; 0 = its first
  SurfaceRole role = SurfaceRole::kPresented;
  const char* cause = "swap";  ///< why it was taken: "swap", "finish", "flush", "readpixels", "target"
  std::string origin;          ///< of its surface: "window", "texture 3"
  bool srgb = false;           ///< its values are encoded as sRGB
  std::string damage;  ///< "x y width height;…" from the bottom left, as presented; empty = everything

  ReadWay way = ReadWay::kSync;
  bool partial = false;            ///< its buffer may be smaller than what is read: the rest is to be 0
  uint64_t buffered_ns = 0;        ///< of kBoth: what the read into a pixel buffer took; 0 = cannot be done
  std::unique_ptr<LateRead> late;  ///< of kAsync, until it is posted to the late reader
  std::function<void(bool whole)> arrive;  ///< to be called there once, from any thread

  // The frame queue's, under its lock.
  bool awaited = false;   ///< the pixels have not arrived yet
  bool lost = false;      ///< they never will
  bool unwanted = false;  ///< released before they arrived
  CapturedFrame* next = nullptr;  ///< in the same list

  SurfaceView view;  ///< lies in `pixels`

  /// Room for `bytes` bytes, contents undefined; null if there is no memory.
  std::byte* reserve(size_t bytes) { return pixels_.reserve(bytes); }

 private:
  PixelMemory pixels_;
};

}  // namespace tilepress
