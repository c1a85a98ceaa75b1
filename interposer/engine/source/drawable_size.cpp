// Drawable size: GetGeometry and GetWindowAttributes through XCB. The engine links no X library and looks the
// functions up.
#include "interposer/engine/source/drawable_size.h"

#include <GL/glx.h>
#include <dlfcn.h>

#include <cstdlib>
#include <initializer_list>
#include <type_traits>

namespace tilepress {

DrawableSize::DrawableSize(const LibrarySymbols& library) {
  dlopen("libX11-xcb.so.1", RTLD_LAZY | RTLD_LOCAL);
  dlerror();
  const auto fill = [&](auto& function, const char* file, const char* name) {
    function =
        reinterpret_cast<std::remove_reference_t<decltype(function)>>(library.find_in_loaded(file, name));
  };
  fill(get_connection_, "libX11-xcb.so.1", "XGetXCBConnection");
  fill(get_geometry_, "libxcb.so.1", "xcb_get_geometry");
  fill(get_geometry_reply_, "libxcb.so.1", "xcb_get_geometry_reply");
  fill(get_attributes_, "libxcb.so.1", "xcb_get_window_attributes");
  fill(get_attributes_reply_, "libxcb.so.1", "xcb_get_window_attributes_reply");
  fill(get_glx_attributes_, "libxcb-glx.so.0", "xcb_glx_get_drawable_attributes");
  fill(get_glx_attributes_reply_, "libxcb-glx.so.0", "xcb_glx_get_drawable_attributes_reply");
}

bool DrawableSize::query(Display* display, XID drawable, unsigned& width, unsigned& height,
                         VisualID& visual) const {
  if (get_connection_ == nullptr || get_geometry_ == nullptr || get_geometry_reply_ == nullptr ||
      get_attributes_ == nullptr || get_attributes_reply_ == nullptr)
    return false;
  xcb_connection_t* connection = get_connection_(display);
  const auto id = static_cast<uint32_t>(drawable);
  const auto size_asked = get_geometry_(connection, id);
  const auto visual_asked = get_attributes_(connection, id);
  xcb_generic_error_t* errors[2] = {};
  auto* size = get_geometry_reply_(connection, size_asked, &errors[0]);
  auto* attributes = get_attributes_reply_(connection, visual_asked, &errors[1]);
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

bool DrawableSize::query_glx(Display* display, XID drawable, GlxDrawable& found) const {
  if (get_connection_ == nullptr || get_glx_attributes_ == nullptr || get_glx_attributes_reply_ == nullptr)
    return false;
  xcb_connection_t* connection = get_connection_(display);
  xcb_generic_error_t* error = nullptr;
  const GlxCookie asked = get_glx_attributes_(connection, static_cast<uint32_t>(drawable));
  GlxReply* reply = get_glx_attributes_reply_(connection, asked, &error);
  found = {};
  for (uint32_t i = 0; reply != nullptr && i < reply->attribute_count && 2 * i + 1 < reply->length; ++i) {
    const uint32_t* attribute = reinterpret_cast<const uint32_t*>(reply + 1) + size_t{2} * i;
    if (attribute[0] == GLX_WIDTH) found.width = attribute[1];
    if (attribute[0] == GLX_HEIGHT) found.height = attribute[1];
    if (attribute[0] == GLX_FBCONFIG_ID) found.config = attribute[1];
    if (attribute[0] == GLX_SCREEN) found.screen = static_cast<int>(attribute[1]);
  }
  free(reply);
  free(error);
  return found.width > 0 && found.height > 0 && found.config > 0;
}

}  // namespace tilepress
