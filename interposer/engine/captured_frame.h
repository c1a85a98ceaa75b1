// Captured frame: the pixels of one presented frame on their way from the program's thread to the worker.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "interposer/engine/pixel_memory.h"
#include "interposer/engine/surface_registry.h"
#include "tilepress/surface.h"

namespace tilepress {

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

  SurfaceView view;  ///< lies in `pixels`

  /// Room for `bytes` bytes, contents undefined; null if there is no memory.
  std::byte* reserve(size_t bytes) { return pixels_.reserve(bytes); }

 private:
  PixelMemory pixels_;
};

}  // namespace tilepress
