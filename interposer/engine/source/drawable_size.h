// Drawable size: queries the size and config of an X window or GLX drawable. No X error reaches the program's
// error handler.
#pragma once

#include <X11/Xlib.h>
#include <xcb/xproto.h>

#include "interposer/engine/source/library_symbols.h"

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
  // Types of xcb/glx.h, which is in a package of its own. Pairs of name and value follow the reply.
  struct GlxCookie {
    unsigned sequence;
  };
  struct GlxReply {
    uint8_t type, unused;
    uint16_t sequence;
    uint32_t length, attribute_count, unused_words[5];
  };
  xcb_connection_t* (*get_connection_)(Display*) = nullptr;
  decltype(&xcb_get_geometry) get_geometry_ = nullptr;
  decltype(&xcb_get_geometry_reply) get_geometry_reply_ = nullptr;
  decltype(&xcb_get_window_attributes) get_attributes_ = nullptr;
  decltype(&xcb_get_window_attributes_reply) get_attributes_reply_ = nullptr;
  GlxCookie (*get_glx_attributes_)(xcb_connection_t*, uint32_t) = nullptr;
  GlxReply* (*get_glx_attributes_reply_)(xcb_connection_t*, GlxCookie, xcb_generic_error_t**) = nullptr;
};

}  // namespace tilepress
