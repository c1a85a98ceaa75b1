// Surface registry: numbers windows, surfaces and frames.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "tilepress/pixel_format.h"
#include "tilepress/run_directory.h"

namespace tilepress {

/// Presented: what the program shows or hands out. Target: an image of a framebuffer object on the way there.
enum class SurfaceRole : uint8_t { kPresented, kTarget };

/// What a program draws to: a display and a surface as the native API names them, or a context and an image.
struct WindowKey {
  const void* display;
  uintptr_t surface;
  SurfaceRole role = SurfaceRole::kPresented;
  bool operator==(const WindowKey&) const = default;
};

/// Size and pixel format. `format` is empty if no known format has these channels.
struct SurfaceShape {
  uint32_t width = 0, height = 0;
  std::optional<PixelFormat> format;
  bool srgb = false;       ///< the values are encoded as sRGB
  bool resizable = false;  ///< the window manager may change the size at any time
  bool operator==(const SurfaceShape&) const = default;
};

/// What a present shows, as a source describes it once per frame.
struct Drawable {
  WindowKey key{};
  SurfaceShape shape;
  void* config = nullptr;       ///< EGLConfig or GLXFBConfig, valid as long as the display; null for OSMesa
  bool double_buffered = true;  ///< GLX only: an EGL surface has a query of its own
  bool multisampled = false;    ///< a read must resolve the drawable first
};

/// A surface is a buffer with a size and a pixel format. When a window changes either, its next frame is
/// frame 0 of a new surface.
class SurfaceRegistry {
 public:
  /// Windows known at a time. The shim does not learn when an X window ends, so the registry forgets the
  /// window whose last present is the oldest.
  static constexpr size_t kMaxWindows = 64;
  static constexpr size_t kMaxTargets = 256;  ///< the same for targets

  struct Turn {
    uint32_t window, surface;
    uint64_t frame;
    uint64_t interval_ns;               ///< since the window's last present, from call to call; 0 = its first
    std::optional<uint32_t> forgotten;  ///< a window that the registry forgot to make room
    bool new_shape;                     ///< no presenting call has shown the window at this shape yet
  };
  /// Returns the numbers of the window's next frame. Changes nothing but the shape. Thread-safe, as all
  /// members.
  Turn turn(const WindowKey& key, const SurfaceShape& shape, uint64_t now_ns);
  /// The window has presented the frame that turn() numbered, in a call that came in at `begin_ns`.
  /// `triggered`: the call was no presenting call, and the program goes on drawing into the same buffer.
  void presented(uint32_t window, uint64_t begin_ns, bool triggered);
  /// The window is gone, and a later window may get its handle. Returns the window's number if it was known.
  std::optional<uint32_t> forget(const WindowKey& key);
  /// Targets of `context` are gone: those whose image equals `image` in the bits of `mask`, so all if `mask`
  /// is 0. Returns their numbers.
  std::vector<uint32_t> forget_targets(const void* context, uintptr_t image = 0, uintptr_t mask = 0);
  /// Returns true the first time for `surface`, for a line that the log should have once.
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
