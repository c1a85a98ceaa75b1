// GL functions: the GL calls of the readback, looked up in the program's own library.
#pragma once

#include <GL/gl.h>

#include <cstddef>
#include <cstdint>
#include <functional>

// X(name, result, arguments...)
// clang-format off
#define TILEPRESS_GL_REQUIRED(X) \
  X(GetString, const GLubyte*, GLenum) \
  X(GetIntegerv, void, GLenum, GLint*) \
  X(GetError, GLenum) \
  X(PixelStorei, void, GLenum, GLint) \
  X(ReadPixels, void, GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*)

/// Each may be null. A resolve of a multisampled image needs all from GenFramebuffers on.
#define TILEPRESS_GL_OPTIONAL(X) \
  X(GetStringi, const GLubyte*, GLenum, GLuint) \
  X(GetFloatv, void, GLenum, GLfloat*) \
  X(PixelTransferi, void, GLenum, GLint) \
  X(PixelTransferf, void, GLenum, GLfloat) \
  X(ClampColor, void, GLenum, GLenum) \
  X(MatrixMode, void, GLenum) \
  X(LoadMatrixf, void, const GLfloat*) \
  X(ReadBuffer, void, GLenum) \
  X(ReadBufferNV, void, GLenum) /* OpenGL ES 2 */ \
  X(IsEnabled, GLboolean, GLenum) \
  X(Enable, void, GLenum) \
  X(Disable, void, GLenum) \
  X(GenBuffers, void, GLsizei, GLuint*) \
  X(DeleteBuffers, void, GLsizei, const GLuint*) \
  X(BufferData, void, GLenum, ptrdiff_t, const void*, GLenum) \
  X(MapBufferRange, void*, GLenum, ptrdiff_t, ptrdiff_t, GLbitfield) \
  X(UnmapBuffer, GLboolean, GLenum) \
  X(FenceSync, void*, GLenum, GLbitfield) \
  X(ClientWaitSync, GLenum, void*, GLbitfield, uint64_t) \
  X(DeleteSync, void, void*) \
  X(Flush, void) \
  X(BindBuffer, void, GLenum, GLuint) \
  X(BindFramebuffer, void, GLenum, GLuint) \
  X(BindFramebufferEXT, void, GLenum, GLuint) /* OpenGL before 3.0 */ \
  X(BindFramebufferOES, void, GLenum, GLuint) /* OpenGL ES 1 */ \
  X(CheckFramebufferStatus, GLenum, GLenum) \
  X(GetFramebufferAttachmentParameteriv, void, GLenum, GLenum, GLenum, GLint*) \
  X(IsTexture, GLboolean, GLuint) \
  X(BindTexture, void, GLenum, GLuint) \
  X(GetTexLevelParameteriv, void, GLenum, GLint, GLenum, GLint*) \
  X(IsRenderbuffer, GLboolean, GLuint) \
  X(BindRenderbuffer, void, GLenum, GLuint) \
  X(GetRenderbufferParameteriv, void, GLenum, GLenum, GLint*) \
  X(GetTextureLevelParameteriv, void, GLuint, GLint, GLenum, GLint*) /* OpenGL 4.5 */ \
  X(GetNamedRenderbufferParameteriv, void, GLuint, GLenum, GLint*) /* OpenGL 4.5 */ \
  X(GenFramebuffers, void, GLsizei, GLuint*) \
  X(DeleteFramebuffers, void, GLsizei, const GLuint*) \
  X(FramebufferRenderbuffer, void, GLenum, GLenum, GLenum, GLuint) \
  X(FramebufferTexture2D, void, GLenum, GLenum, GLenum, GLuint, GLint) \
  X(FramebufferTextureLayer, void, GLenum, GLenum, GLuint, GLint, GLint) \
  X(GenRenderbuffers, void, GLsizei, GLuint*) \
  X(DeleteRenderbuffers, void, GLsizei, const GLuint*) \
  X(RenderbufferStorage, void, GLenum, GLenum, GLsizei, GLsizei) \
  X(BlitFramebuffer, void, GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLbitfield, GLenum)
// clang-format on

namespace tilepress {

struct GlFunctions {
#define TILEPRESS_MEMBER(name, result, ...) result (*name)(__VA_ARGS__) = nullptr;
  TILEPRESS_GL_REQUIRED(TILEPRESS_MEMBER)
  TILEPRESS_GL_OPTIONAL(TILEPRESS_MEMBER)
#undef TILEPRESS_MEMBER

  using Lookup = std::function<void*(const char*)>;
  /// Returns false if a required function is missing.
  bool load(const Lookup& look_up) {
#define TILEPRESS_FILL(name, result, ...) \
  name = reinterpret_cast<result (*)(__VA_ARGS__)>(look_up("gl" #name));
    TILEPRESS_GL_REQUIRED(TILEPRESS_FILL)
    TILEPRESS_GL_OPTIONAL(TILEPRESS_FILL)
#undef TILEPRESS_FILL
    if (ClampColor == nullptr)
      ClampColor = reinterpret_cast<decltype(ClampColor)>(look_up("glClampColorARB"));
    return GetString != nullptr && GetIntegerv != nullptr && GetError != nullptr && PixelStorei != nullptr &&
           ReadPixels != nullptr;
  }
  /// Core profiles and old versions lack some queries.
  void clear_errors() const {
    while (GetError() != GL_NO_ERROR) {
    }
  }
};

}  // namespace tilepress
