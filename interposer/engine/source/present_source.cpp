// Present source: what the strings of the program's context say.
#include "interposer/engine/source/present_source.h"

#include <cstring>

namespace tilepress {

static const char* text_of(const GlFunctions& gl, GLenum name) {
  const auto* text = reinterpret_cast<const char*>(gl.GetString(name));
  return text != nullptr ? text : "";
}

GlStrings PresentSource::strings() const {
  return {text_of(gl(), GL_VENDOR), text_of(gl(), GL_RENDERER), text_of(gl(), GL_VERSION)};
}

bool PresentSource::draws_in_software() const {
  if (context() == nullptr) return false;
  const char* renderer = text_of(gl(), GL_RENDERER);
  for (const char* name : {"llvmpipe", "softpipe", "SWR", "Software Rasterizer"})
    if (strstr(renderer, name) != nullptr) return true;
  return false;
}

}  // namespace tilepress
