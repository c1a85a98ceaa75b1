// GL functions: the few GL calls the readback makes, looked up through the program's own library.
#pragma once

#include <GL/gl.h>

#include <functional>

namespace tilepress {

/// Pointers without a remark are set, or the table is not usable.
struct GlFunctions {
  const GLubyte* (*GetString)(GLenum) = nullptr;
  void (*GetIntegerv)(GLenum, GLint*) = nullptr;
  GLenum (*GetError)() = nullptr;
  void (*PixelStorei)(GLenum, GLint) = nullptr;
  void (*ReadBuffer)(GLenum) = nullptr;               ///< null in OpenGL ES 2
  void (*BindFramebuffer)(GLenum, GLuint) = nullptr;  ///< may be null
  void (*BindBuffer)(GLenum, GLuint) = nullptr;       ///< may be null
  void (*ReadPixels)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*) = nullptr;

  using Lookup = std::function<void*(const char*)>;
  /// False if a function is missing.
  bool load(const Lookup& look_up);
};

}  // namespace tilepress
