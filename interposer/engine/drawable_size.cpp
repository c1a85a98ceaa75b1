// Drawable size: GetGeometry through XCB, whose functions are looked up because the engine links no X
// library.
#include "interposer/engine/drawable_size.h"

#include <dlfcn.h>
#include <xcb/xproto.h>

#include <cstdlib>

namespace tilepress {

DrawableSize::DrawableSize(const LibrarySymbols& library) {
  dlopen("libX11-xcb.so.1", RTLD_LAZY | RTLD_LOCAL);
  dlerror();
  get_connection_ =
      reinterpret_cast<GetConnection>(library.find_in_loaded("libX11-xcb.so.1", "XGetXCBConnection"));
  get_geometry_ = library.find_in_loaded("libxcb.so.1", "xcb_get_geometry");
  get_geometry_reply_ = library.find_in_loaded("libxcb.so.1", "xcb_get_geometry_reply");
}

bool DrawableSize::query(Display* display, XID drawable, unsigned& width, unsigned& height) const {
  if (get_connection_ == nullptr || get_geometry_ == nullptr || get_geometry_reply_ == nullptr) return false;
  xcb_connection_t* connection = get_connection_(display);
  const auto cookie = reinterpret_cast<decltype(&xcb_get_geometry)>(get_geometry_)(
      connection, static_cast<xcb_drawable_t>(drawable));
  xcb_generic_error_t* error = nullptr;
  xcb_get_geometry_reply_t* reply =
      reinterpret_cast<decltype(&xcb_get_geometry_reply)>(get_geometry_reply_)(connection, cookie, &error);
  if (reply != nullptr) {
    width = reply->width;
    height = reply->height;
  }
  const bool known = reply != nullptr;
  free(reply);
  free(error);
  return known;
}

}  // namespace tilepress
