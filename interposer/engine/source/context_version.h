// Context version: says which queries a context has, so that none raises an error.
#pragma once

#include "interposer/engine/source/gl_functions.h"

namespace tilepress {

struct ContextVersion {
  bool embedded = false;  ///< OpenGL ES
  int number = 0;         ///< 10 · major + minor; 0 = unknown
  bool separate_by_extension = false;

  /// True if reading and drawing have separate framebuffer bindings.
  bool separate_framebuffers() const { return number >= 30 || separate_by_extension; }
};

/// The version of the current context.
ContextVersion version_of(const GlFunctions& gl);

/// Returns true if the list `all` holds one of the names in `wanted`. Blanks separate the names of both.
bool holds_extension(const char* all, const char* wanted);

/// Returns true if a context below version 3 has one of these extensions. Later versions have profiles
/// without the string of all extensions.
bool has_early_extension(const GlFunctions& gl, const ContextVersion& version, const char* wanted);

}  // namespace tilepress
