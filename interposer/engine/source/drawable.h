// Drawable: what a present shows, as a source describes it once per frame.
#pragma once

#include "interposer/engine/surface_registry.h"

namespace tilepress {

struct Drawable {
  WindowKey key{};
  SurfaceShape shape;
  void* config = nullptr;       ///< EGLConfig or GLXFBConfig, valid as long as the display; null for OSMesa
  bool double_buffered = true;  ///< GLX only: an EGL surface has a query of its own
  bool multisampled = false;    ///< a read must resolve the drawable first
};

}  // namespace tilepress
