// Surface registry: which window is which surface, and how many frames it has presented.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "tilepress/pixel_format.h"
#include "tilepress/run_directory.h"

namespace tilepress {

/// Presented: what the program shows or hands out. Target: a framebuffer object's image on the way there.
enum class SurfaceRole : uint8_t { kPresented, kTarget };

/// What a program draws to, as the native API names it: display and surface, or a context and one of its
/// images.
struct WindowKey {
  const void* display;
  uintptr_t surface;
  SurfaceRole role = SurfaceRole::kPresented;
  bool operator==(const WindowKey&) const = default;
};

/// Size and pixel format. `format` is empty where the bits fit none of the known formats.
struct SurfaceShape {
  uint32_t width = 0, height = 0;
  std::optional<PixelFormat> format;
  bool srgb = false;       ///< its values are encoded as sRGB
  bool resizable = false;  ///< another may give it another size at any time, as a window
  bool operator==(const SurfaceShape&) const = default;
};

/// Numbers a present of a window. A surface is a buffer with a size and a pixel format: when a window changes
/// either, its next frame is frame 0 of a new surface.
class SurfaceRegistry {
 public:
  /// Windows known at a time: of an X window nobody tells us when it ends, so the one that has not presented
  /// for the longest time is forgotten.
  static constexpr size_t kMaxWindows = 64;
  static constexpr size_t kMaxTargets = 256;  ///< the same for targets

  struct Turn {
    uint32_t window, surface;
    uint64_t frame;
    uint64_t interval_ns;               ///< since the window's last present, from call to call; 0 = its first
    std::optional<uint32_t> forgotten;  ///< a window that had to make room
    bool new_shape;  ///< no presenting call was made since the window was first met, or met at this shape
  };
  /// The numbers the next frame of the window bears; asking changes nothing but the shape. Thread-safe.
  Turn turn(const WindowKey& key, const SurfaceShape& shape, uint64_t now_ns);
  /// The window has presented the frame that turn() numbered, in a call that came in at `begin_ns`; it goes
  /// on drawing into the same buffer if that was `triggered` by another call than a presenting one.
  void presented(uint32_t window, uint64_t begin_ns, bool triggered);
  /// The window is gone: what presents under its handle later is another. Its number, if it was known.
  std::optional<uint32_t> forget(const WindowKey& key);
  /// The targets of `context` are gone: all, or those whose image has these bits where `mask` is set. Their
  /// numbers.
  std::vector<uint32_t> forget_targets(const void* context, uintptr_t image = 0, uintptr_t mask = 0);
  /// True the first time it is asked for `surface`: a thing to be said once.
  bool first_report(uint32_t surface);

 private:
  struct Window {
    WindowKey key;
    SurfaceShape shape;
    uint32_t number;
    uint32_t surface;
    uint64_t frames;
    uint64_t last_turn;
    uint64_t last_ns;  ///< 0 = has not presented
    bool new_shape;    ///< as in Turn
  };
  std::mutex mutex_;
  std::vector<Window> windows_;
  std::vector<uint32_t> reported_;
  uint32_t window_count_ = 0, surface_count_ = 0, target_count_ = kFirstTargetSurface;
  uint64_t turns_ = 0;
};

}  // namespace tilepress
