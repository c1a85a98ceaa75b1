// Drawable size: the size of an X window or GLX drawable and what it was made for, asked so that no X error
// can reach the program's error handler.
#pragma once

#include <X11/Xlib.h>

#include "interposer/engine/source/library_symbols.h"

struct xcb_connection_t;

namespace tilepress {

/// Uses XCB on the program's own connection: an error comes back with the reply instead of through Xlib's
/// handler.
class DrawableSize {
 public:
  explicit DrawableSize(const LibrarySymbols& library);
  /// False if `drawable` is neither a window nor a pixmap of the server, or XCB is not to be had. `visual` is
  /// a window's, else 0. One round trip to the server.
  bool query(Display* display, XID drawable, unsigned& width, unsigned& height, VisualID& visual) const;

  struct GlxDrawable {
    uint32_t width = 0, height = 0;
    uint32_t config = 0;  ///< GLX_FBCONFIG_ID
    int screen = -1;      ///< -1: the server does not tell
  };
  /// What the server knows of a GLX window or pbuffer; false if it is none. One round trip.
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
