// GL functions: the GL calls of the readback, looked up in the program's own library.
#pragma once

#include <GL/gl.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace tilepress {

/// The functions of the first block are always set after load(). All others may be null.
struct GlFunctions {
  const GLubyte* (*GetString)(GLenum) = nullptr;
  void (*GetIntegerv)(GLenum, GLint*) = nullptr;
  GLenum (*GetError)() = nullptr;
  void (*PixelStorei)(GLenum, GLint) = nullptr;
  void (*ReadPixels)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*) = nullptr;

  const GLubyte* (*GetStringi)(GLenum, GLuint) = nullptr;
  void (*GetFloatv)(GLenum, GLfloat*) = nullptr;
  void (*PixelTransferi)(GLenum, GLint) = nullptr;
  void (*PixelTransferf)(GLenum, GLfloat) = nullptr;
  void (*ClampColor)(GLenum, GLenum) = nullptr;
  void (*MatrixMode)(GLenum) = nullptr;
  void (*LoadMatrixf)(const GLfloat*) = nullptr;
  void (*ReadBuffer)(GLenum) = nullptr;
  void (*ReadBufferNV)(GLenum) = nullptr;  ///< OpenGL ES 2
  GLboolean (*IsEnabled)(GLenum) = nullptr;
  void (*Enable)(GLenum) = nullptr;
  void (*Disable)(GLenum) = nullptr;
  void (*GenBuffers)(GLsizei, GLuint*) = nullptr;
  void (*DeleteBuffers)(GLsizei, const GLuint*) = nullptr;
  void (*BufferData)(GLenum, ptrdiff_t, const void*, GLenum) = nullptr;
  void* (*MapBufferRange)(GLenum, ptrdiff_t, ptrdiff_t, GLbitfield) = nullptr;
  GLboolean (*UnmapBuffer)(GLenum) = nullptr;
  void* (*FenceSync)(GLenum, GLbitfield) = nullptr;
  GLenum (*ClientWaitSync)(void*, GLbitfield, uint64_t) = nullptr;
  void (*DeleteSync)(void*) = nullptr;
  void (*Flush)() = nullptr;
  void (*BindBuffer)(GLenum, GLuint) = nullptr;
  void (*BindFramebuffer)(GLenum, GLuint) = nullptr;
  void (*BindFramebufferEXT)(GLenum, GLuint) = nullptr;  ///< OpenGL before 3.0
  void (*BindFramebufferOES)(GLenum, GLuint) = nullptr;  ///< OpenGL ES 1
  GLenum (*CheckFramebufferStatus)(GLenum) = nullptr;
  void (*GetFramebufferAttachmentParameteriv)(GLenum, GLenum, GLenum, GLint*) = nullptr;
  GLboolean (*IsTexture)(GLuint) = nullptr;
  void (*BindTexture)(GLenum, GLuint) = nullptr;
  void (*GetTexLevelParameteriv)(GLenum, GLint, GLenum, GLint*) = nullptr;
  GLboolean (*IsRenderbuffer)(GLuint) = nullptr;
  void (*BindRenderbuffer)(GLenum, GLuint) = nullptr;
  void (*GetRenderbufferParameteriv)(GLenum, GLenum, GLint*) = nullptr;
  void (*GetTextureLevelParameteriv)(GLuint, GLint, GLenum, GLint*) = nullptr;  ///< OpenGL 4.5
  void (*GetNamedRenderbufferParameteriv)(GLuint, GLenum, GLint*) = nullptr;    ///< OpenGL 4.5

  // A resolve of a multisampled image needs all of these.
  void (*GenFramebuffers)(GLsizei, GLuint*) = nullptr;
  void (*DeleteFramebuffers)(GLsizei, const GLuint*) = nullptr;
  void (*FramebufferRenderbuffer)(GLenum, GLenum, GLenum, GLuint) = nullptr;
  void (*FramebufferTexture2D)(GLenum, GLenum, GLenum, GLuint, GLint) = nullptr;
  void (*FramebufferTextureLayer)(GLenum, GLenum, GLuint, GLint, GLint) = nullptr;
  void (*GenRenderbuffers)(GLsizei, GLuint*) = nullptr;
  void (*DeleteRenderbuffers)(GLsizei, const GLuint*) = nullptr;
  void (*RenderbufferStorage)(GLenum, GLenum, GLsizei, GLsizei) = nullptr;
  void (*BlitFramebuffer)(GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLbitfield,
                          GLenum) = nullptr;

  using Lookup = std::function<void*(const char*)>;
  /// Returns false if a function of the first block is missing.
  bool load(const Lookup& look_up);
};

}  // namespace tilepress
