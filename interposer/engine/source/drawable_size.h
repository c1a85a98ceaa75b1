// Drawable size: queries the size and config of an X window or GLX drawable. No X error reaches the program's
// error handler.
#pragma once

#include <X11/Xlib.h>

#include "interposer/engine/source/library_symbols.h"

struct xcb_connection_t;

namespace tilepress {

/// Uses XCB on the program's own connection. XCB returns an error with the reply, and not through Xlib's
/// handler.
class DrawableSize {
 public:
  explicit DrawableSize(const LibrarySymbols& library);
  /// Returns false if `drawable` is neither a window nor a pixmap, or without XCB. `visual` is 0 for a
  /// pixmap. One round trip to the server.
  bool query(Display* display, XID drawable, unsigned& width, unsigned& height, VisualID& visual) const;

  struct GlxDrawable {
    uint32_t width = 0, height = 0;
    uint32_t config = 0;  ///< GLX_FBCONFIG_ID
    int screen = -1;      ///< -1: unknown
  };
  /// Returns false if `drawable` is neither a GLX window nor a pbuffer. One round trip to the server.
  bool query_glx(Display* display, XID drawable, GlxDrawable& found) const;

 private:
  using GetConnection = xcb_connection_t* (*)(Display*);
  GetConnection get_connection_ = nullptr;
  void* get_geometry_ = nullptr;
  void* get_geometry_reply_ = nullptr;
  void* get_attributes_ = nullptr;
  void* get_attributes_reply_ = nullptr;
  void* get_glx_attributes_ = nullptr;
  void* get_glx_attributes_reply_ = nullptr;
};

}  // namespace tilepress
