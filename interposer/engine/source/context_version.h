// Context version: which GL a context speaks, so that it is asked nothing that would raise an error.
#pragma once

#include "interposer/engine/source/gl_functions.h"

namespace tilepress {

struct ContextVersion {
  bool embedded = false;  ///< OpenGL ES
  int number = 0;         ///< 10 · major + minor; 0 = unknown
  bool separate_by_extension = false;

  /// Reading and drawing have framebuffer bindings of their own, with a read buffer each.
  bool separate_framebuffers() const { return number >= 30 || separate_by_extension; }
};

/// Of the current context.
ContextVersion version_of(const GlFunctions& gl);

/// True if `all`, names separated by blanks, holds one of `wanted`, separated by blanks too.
bool holds_extension(const char* all, const char* wanted);

/// True if a context below version 3 has one of these extensions. Those versions alone answer with one string
/// in every profile.
bool has_early_extension(const GlFunctions& gl, const ContextVersion& version, const char* wanted);

}  // namespace tilepress
