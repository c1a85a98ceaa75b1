// Bound framebuffer: queries what the program draws to or reads from, and raises no error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "interposer/engine/readback/channel_bits.h"
#include "interposer/engine/source/context_version.h"
#include "interposer/engine/source/gl_functions.h"

namespace tilepress {

/// One colour attachment of a framebuffer object.
struct Attachment {
  GLenum point = 0;  ///< GL_COLOR_ATTACHMENTi
  bool texture = false;
  GLuint name = 0;  ///< texture or renderbuffer
  GLint level = 0;
  GLenum face = 0;  ///< 0 unless a cube map
  GLint layer = 0;
  ChannelBits bits;
  bool srgb = false;

  /// A number that no other image of the context has, for a WindowKey.
  uintptr_t image() const;
  /// "texture 5", "texture 5 level 2 layer 1", "renderbuffer 3".
  std::string text() const;
};

enum class FramebufferUse { kDraw, kRead };

/// Returns the name of the framebuffer object that is bound in the current context. 0 is the default
/// framebuffer, also in a context without framebuffer objects.
GLuint bound_framebuffer(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use);

/// Binds framebuffer object `name` with the function of the context's version. Returns false if there is
/// none.
bool bind_framebuffer(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use, GLuint name);

/// Returns the buffers that the context draws to, or the one it reads from: GL_COLOR_ATTACHMENTi of a
/// framebuffer object, GL_BACK and the like of the default framebuffer. Leaves out GL_NONE.
std::vector<GLenum> buffers_in_use(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use);

/// Returns true if the bound framebuffer object is complete.
bool is_complete(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use);

/// Describes the attachment at `point` of the bound framebuffer object, which must not be 0. Returns false if
/// nothing is attached there.
bool describe_attachment(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use,
                         GLenum point, Attachment& out);

}  // namespace tilepress
