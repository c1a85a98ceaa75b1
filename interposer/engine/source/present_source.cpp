// Present source: what the strings of the program's context say.
#include "interposer/engine/source/present_source.h"

#include <cstring>

namespace tilepress {

const char* PresentSource::string(GLenum name) const {
  const auto* text = reinterpret_cast<const char*>(gl().GetString(name));
  return text != nullptr ? text : "";
}

bool PresentSource::draws_in_software() const {
  if (context() == nullptr) return false;
  const char* renderer = string(GL_RENDERER);
  for (const char* name : {"llvmpipe", "softpipe", "SWR", "Software Rasterizer"})
    if (strstr(renderer, name) != nullptr) return true;
  return false;
}

}  // namespace tilepress
