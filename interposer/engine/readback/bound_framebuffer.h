// Bound framebuffer: what the program draws to or reads from, asked so that no error can arise.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interposer/engine/source/context_version.h"
#include "interposer/engine/source/gl_functions.h"
#include "interposer/engine/readback/gl_readback.h"

namespace tilepress {

/// One colour attachment of a framebuffer object.
struct Attachment {
  GLenum point = 0;  ///< GL_COLOR_ATTACHMENTi
  bool texture = false;
  GLuint name = 0;  ///< of the texture or renderbuffer
  GLint level = 0;
  GLenum face = 0;  ///< of a cube map, else 0
  GLint layer = 0;
  ChannelBits bits;
  bool srgb = false;

  /// Which image it is, among all of a context: 64 bits for a WindowKey.
  uintptr_t image() const;
  /// "texture 5", "texture 5 level 2 layer 1", "renderbuffer 3".
  std::string text() const;
};

enum class FramebufferUse { kDraw, kRead };

/// Name of the framebuffer object bound in the current context; 0 = the default framebuffer, also where the
/// context knows no framebuffer objects.
GLuint bound_framebuffer(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use);

/// Binds framebuffer object `name` by the function that belongs to the context's version. False if there is
/// none.
bool bind_framebuffer(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use, GLuint name);

/// The points that drawing goes to, or the one that is read from: GL_COLOR_ATTACHMENTi of a framebuffer
/// object, GL_BACK and the like of the default framebuffer. Without GL_NONE.
std::vector<GLenum> buffers_in_use(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use);

/// True if the bound framebuffer object can be drawn to or read from.
bool is_complete(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use);

/// The attachment at `point` of the bound framebuffer object, which must not be 0. False if nothing is
/// attached.
bool describe_attachment(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use,
                         GLenum point, Attachment& out);

}  // namespace tilepress
