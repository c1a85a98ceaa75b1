// Drawable size: GetGeometry and GetWindowAttributes through XCB, whose functions are looked up because the
// engine links no X library.
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
  get_attributes_ = library.find_in_loaded("libxcb.so.1", "xcb_get_window_attributes");
  get_attributes_reply_ = library.find_in_loaded("libxcb.so.1", "xcb_get_window_attributes_reply");
}

bool DrawableSize::query(Display* display, XID drawable, unsigned& width, unsigned& height,
                         VisualID& visual) const {
  if (get_connection_ == nullptr || get_geometry_ == nullptr || get_geometry_reply_ == nullptr ||
      get_attributes_ == nullptr || get_attributes_reply_ == nullptr)
    return false;
  xcb_connection_t* connection = get_connection_(display);
  const auto id = static_cast<uint32_t>(drawable);
  const auto size_asked = reinterpret_cast<decltype(&xcb_get_geometry)>(get_geometry_)(connection, id);
  const auto visual_asked =
      reinterpret_cast<decltype(&xcb_get_window_attributes)>(get_attributes_)(connection, id);
  xcb_generic_error_t* errors[2] = {};
  auto* size = reinterpret_cast<decltype(&xcb_get_geometry_reply)>(get_geometry_reply_)(
      connection, size_asked, &errors[0]);
  auto* attributes = reinterpret_cast<decltype(&xcb_get_window_attributes_reply)>(get_attributes_reply_)(
      connection, visual_asked, &errors[1]);
  if (size != nullptr) {
    width = size->width;
    height = size->height;
  }
  visual = attributes != nullptr ? attributes->visual : 0;
  const bool known = size != nullptr;
  for (void* answer : {static_cast<void*>(size), static_cast<void*>(attributes),
                       static_cast<void*>(errors[0]), static_cast<void*>(errors[1])})
    free(answer);
  return known;
}

}  // namespace tilepress
