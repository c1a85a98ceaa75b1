// Attachment shape: by name where OpenGL has that, else by binding.
#include "interposer/engine/readback/attachment_shape.h"

#include <GL/gl.h>
#include <GL/glext.h>

namespace tilepress {
namespace {

struct TextureTarget {
  GLenum bind, image;  // `image`: to ask about, of a cube map any face
  bool multisampled;
  bool embedded;  // OpenGL ES knows it
};

constexpr TextureTarget kTargets[] = {
    {GL_TEXTURE_2D, GL_TEXTURE_2D, false, true},
    {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_CUBE_MAP_POSITIVE_X, false, true},
    {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_2D_ARRAY, false, true},
    {GL_TEXTURE_3D, GL_TEXTURE_3D, false, true},
    {GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_2D_MULTISAMPLE, true, true},
    {GL_TEXTURE_RECTANGLE, GL_TEXTURE_RECTANGLE, false, false},
    {GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_CUBE_MAP_ARRAY, false, true},
    {GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_2D_MULTISAMPLE_ARRAY, true, true},
    {GL_TEXTURE_1D, GL_TEXTURE_1D, false, false},
};

bool settle(const Attachment& attachment, GLint width, GLint height, SurfaceShape& shape) {
  shape = {static_cast<uint32_t>(width), static_cast<uint32_t>(height), format_of(attachment.bits),
           attachment.srgb};
  return width > 0 && height > 0;
}

void clear_errors(const GlFunctions& gl) {
  while (gl.GetError() != GL_NO_ERROR) {
  }
}

}  // namespace

bool shape_in_program_context(const GlFunctions& gl, const Attachment& attachment, SurfaceShape& shape,
                              GLint& samples) {
  const ContextVersion version = version_of(gl);
  GLint width = 0, height = 0;
  if (version.embedded || version.number < 45 || gl.GetTextureLevelParameteriv == nullptr ||
      gl.GetNamedRenderbufferParameteriv == nullptr || gl.IsTexture == nullptr ||
      gl.IsRenderbuffer == nullptr)
    return false;
  if (attachment.texture ? !gl.IsTexture(attachment.name) : !gl.IsRenderbuffer(attachment.name)) return false;
  if (attachment.texture) {
    gl.GetTextureLevelParameteriv(attachment.name, attachment.level, GL_TEXTURE_WIDTH, &width);
    gl.GetTextureLevelParameteriv(attachment.name, attachment.level, GL_TEXTURE_HEIGHT, &height);
    gl.GetTextureLevelParameteriv(attachment.name, attachment.level, GL_TEXTURE_SAMPLES, &samples);
  } else {
    gl.GetNamedRenderbufferParameteriv(attachment.name, GL_RENDERBUFFER_WIDTH, &width);
    gl.GetNamedRenderbufferParameteriv(attachment.name, GL_RENDERBUFFER_HEIGHT, &height);
    gl.GetNamedRenderbufferParameteriv(attachment.name, GL_RENDERBUFFER_SAMPLES, &samples);
  }
  return settle(attachment, width, height, shape);
}

bool shape_in_sharing_context(const GlFunctions& gl, const Attachment& attachment, SurfaceShape& shape,
                              GLint& samples, std::string& reason) {
  const ContextVersion version = version_of(gl);
  GLint width = 0, height = 0;
  samples = 0;
  clear_errors(gl);
  if (attachment.texture ? gl.IsTexture == nullptr || !gl.IsTexture(attachment.name)
                         : gl.IsRenderbuffer == nullptr || !gl.IsRenderbuffer(attachment.name)) {
    reason = "the image is deleted";  // binding its name would make another
    return false;
  }
  if (!attachment.texture) {
    gl.BindRenderbuffer(GL_RENDERBUFFER, attachment.name);
    gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_WIDTH, &width);
    gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_HEIGHT, &height);
    if (version.number >= 30)
      gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_SAMPLES, &samples);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
  } else if (gl.GetTexLevelParameteriv == nullptr || (version.embedded && version.number < 31)) {
    reason = "OpenGL ES before 3.1 does not tell the size of a texture";
    return false;
  }
  for (const TextureTarget& target : kTargets) {
    if (!attachment.texture || (version.embedded && !target.embedded)) continue;
    gl.BindTexture(target.bind, attachment.name);
    if (gl.GetError() != GL_NO_ERROR) continue;
    gl.GetTexLevelParameteriv(target.image, attachment.level, GL_TEXTURE_WIDTH, &width);
    gl.GetTexLevelParameteriv(target.image, attachment.level, GL_TEXTURE_HEIGHT, &height);
    if (target.multisampled)
      gl.GetTexLevelParameteriv(target.image, attachment.level, GL_TEXTURE_SAMPLES, &samples);
    gl.BindTexture(target.bind, 0);
    break;
  }
  clear_errors(gl);
  reason = "the size of the image cannot be asked for";
  return settle(attachment, width, height, shape);
}

}  // namespace tilepress
