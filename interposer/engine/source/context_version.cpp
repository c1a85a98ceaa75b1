// Context version: parses the context's own strings.
#include "interposer/engine/source/context_version.h"

#include <cstdio>
#include <cstring>

namespace tilepress {

ContextVersion version_of(const GlFunctions& gl) {
  const auto* text = reinterpret_cast<const char*>(gl.GetString(GL_VERSION));
  ContextVersion version;
  if (text == nullptr) return version;
  version.embedded = strncmp(text, "OpenGL ES", 9) == 0;
  while (*text != 0 && (*text < '0' || *text > '9')) ++text;
  int major = 0, minor = 0;
  if (sscanf(text, "%d.%d", &major, &minor) == 2) version.number = 10 * major + minor;
  version.separate_by_extension = has_early_extension(
      gl, version,
      "GL_ARB_framebuffer_object GL_EXT_framebuffer_blit GL_ANGLE_framebuffer_blit GL_NV_framebuffer_blit "
      "GL_APPLE_framebuffer_multisample");
  return version;
}

bool holds_extension(const char* all, const char* wanted) {
  for (const char* name = wanted; *name != 0;) {
    const size_t length = strcspn(name, " ");
    for (const char* at = all; at != nullptr && *at != 0;) {
      const size_t found = strcspn(at, " ");
      if (found == length && memcmp(at, name, length) == 0) return true;
      at += found;
      at += strspn(at, " ");
    }
    name += length;
    name += strspn(name, " ");
  }
  return false;
}

bool has_early_extension(const GlFunctions& gl, const ContextVersion& version, const char* wanted) {
  if (version.number == 0 || version.number >= 30) return false;
  return holds_extension(reinterpret_cast<const char*>(gl.GetString(GL_EXTENSIONS)), wanted);
}

}  // namespace tilepress
