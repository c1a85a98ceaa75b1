// Context version: which GL a context speaks, so that it is asked nothing that would raise an error.
#pragma once

#include <cstdio>
#include <cstring>

#include "interposer/engine/gl_functions.h"

namespace tilepress {

struct ContextVersion {
  bool embedded = false;  ///< OpenGL ES
  int number = 0;         ///< 10 · major + minor; 0 = unknown

  /// Reading and drawing have framebuffer bindings of their own, with a read buffer each.
  bool separate_framebuffers() const { return number >= 30; }
};

inline ContextVersion version_of(const GlFunctions& gl) {
  const auto* text = reinterpret_cast<const char*>(gl.GetString(GL_VERSION));
  ContextVersion version;
  if (text == nullptr) return version;
  version.embedded = strncmp(text, "OpenGL ES", 9) == 0;
  while (*text != 0 && (*text < '0' || *text > '9')) ++text;
  int major = 0, minor = 0;
  if (sscanf(text, "%d.%d", &major, &minor) == 2) version.number = 10 * major + minor;
  return version;
}

}  // namespace tilepress
