// Bound framebuffer: makes only queries that the context's version has.
#include "interposer/engine/readback/bound_framebuffer.h"

#include <GL/glext.h>

#include <algorithm>

namespace tilepress {
namespace {

bool has_framebuffer_objects(const GlFunctions& gl, const ContextVersion& version) {
  if (gl.CheckFramebufferStatus == nullptr || gl.GetFramebufferAttachmentParameteriv == nullptr) return false;
  if (version.number >= (version.embedded ? 20 : 30)) return true;
  return has_early_extension(gl, version,
                             "GL_ARB_framebuffer_object GL_EXT_framebuffer_object GL_OES_framebuffer_object");
}

GLenum target_of(const ContextVersion& version, FramebufferUse use) {
  if (!version.separate_framebuffers()) return GL_FRAMEBUFFER;
  return use == FramebufferUse::kDraw ? GL_DRAW_FRAMEBUFFER : GL_READ_FRAMEBUFFER;
}

}  // namespace

uintptr_t Attachment::image() const {
  const uint64_t part =
      face != 0 ? face - GL_TEXTURE_CUBE_MAP_POSITIVE_X + 1 : static_cast<uint32_t>(layer) << 3;
  return static_cast<uintptr_t>(uint64_t{texture} << 63 | static_cast<uint64_t>(level & 0x1F) << 58 |
                                (part & 0x3FFFFFF) << 32 | name);
}

std::string Attachment::text() const {
  std::string text = (texture ? "texture " : "renderbuffer ") + std::to_string(name);
  if (level != 0) text += " level " + std::to_string(level);
  if (face != 0) text += " face " + std::to_string(face - GL_TEXTURE_CUBE_MAP_POSITIVE_X);
  if (layer != 0) text += " layer " + std::to_string(layer);
  return text;
}

GLuint bound_framebuffer(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use) {
  if (!has_framebuffer_objects(gl, version)) return 0;
  const bool read = use == FramebufferUse::kRead && version.separate_framebuffers();
  GLint name = 0;
  gl.GetIntegerv(read ? GL_READ_FRAMEBUFFER_BINDING : GL_FRAMEBUFFER_BINDING, &name);
  return static_cast<GLuint>(name);
}

bool bind_framebuffer(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use, GLuint name) {
  const bool early = version.number < (version.embedded ? 20 : 30);
  auto* bind = version.embedded ? gl.BindFramebufferOES : gl.BindFramebufferEXT;
  if (!early || has_early_extension(gl, version, "GL_ARB_framebuffer_object")) bind = gl.BindFramebuffer;
  if (bind != nullptr) bind(target_of(version, use), name);
  return bind != nullptr;
}

std::vector<GLenum> buffers_in_use(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use) {
  const bool object = bound_framebuffer(gl, version, use) != 0;
  std::vector<GLenum> points;
  if (version.embedded && version.number < 30) return {object ? GL_COLOR_ATTACHMENT0 : GLenum{GL_BACK}};
  const auto add = [&](GLenum question) {
    GLint point = GL_NONE;
    gl.GetIntegerv(question, &point);
    if (point != GL_NONE) points.push_back(static_cast<GLenum>(point));
  };
  if (use == FramebufferUse::kRead) {
    add(GL_READ_BUFFER);
  } else if (version.number < 20) {
    add(GL_DRAW_BUFFER);
  } else {
    GLint count = 0;
    gl.GetIntegerv(GL_MAX_DRAW_BUFFERS, &count);
    for (GLint i = 0; i < std::min(count, 16); ++i) add(GL_DRAW_BUFFER0 + static_cast<GLenum>(i));
  }
  return points;
}

bool is_complete(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use) {
  return gl.CheckFramebufferStatus(target_of(version, use)) == GL_FRAMEBUFFER_COMPLETE;
}

bool describe_attachment(const GlFunctions& gl, const ContextVersion& version, FramebufferUse use,
                         GLenum point, Attachment& out) {
  const GLenum target = target_of(version, use);
  const auto ask = [&](GLenum question) {
    GLint value = 0;
    gl.GetFramebufferAttachmentParameteriv(target, point, question, &value);
    return value;
  };
  const GLint type = ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE);
  if (type != GL_TEXTURE && type != GL_RENDERBUFFER) return false;
  out = {};
  out.point = point;
  out.texture = type == GL_TEXTURE;
  out.name = static_cast<GLuint>(ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
  if (out.texture) {
    out.level = ask(GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL);
    out.face = static_cast<GLenum>(ask(GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_CUBE_MAP_FACE));
    if (version.number >= 30) out.layer = ask(GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LAYER);
  }
  if (version.number >= 30) {
    out.bits = {ask(GL_FRAMEBUFFER_ATTACHMENT_RED_SIZE), ask(GL_FRAMEBUFFER_ATTACHMENT_GREEN_SIZE),
                ask(GL_FRAMEBUFFER_ATTACHMENT_BLUE_SIZE), ask(GL_FRAMEBUFFER_ATTACHMENT_ALPHA_SIZE), false};
    const GLint component = ask(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE);
    out.bits.floating = component == GL_FLOAT;
    out.bits.integer =
        component == GL_INT || component == GL_UNSIGNED_INT || component == GL_SIGNED_NORMALIZED;
    out.srgb = ask(GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING) == GL_SRGB;
  } else {
    // Before version 3 a framebuffer has one colour attachment, and these queries are about that one.
    for (const auto& [question, bits] : {std::pair{GL_RED_BITS, &out.bits.red},
                                         {GL_GREEN_BITS, &out.bits.green},
                                         {GL_BLUE_BITS, &out.bits.blue},
                                         {GL_ALPHA_BITS, &out.bits.alpha}})
      gl.GetIntegerv(static_cast<GLenum>(question), bits);
  }
  return true;
}

}  // namespace tilepress
