// Attachment shape: a query by name where OpenGL has one, else a binding.
#include "interposer/engine/readback/attachment_shape.h"

#include <GL/gl.h>
#include <GL/glext.h>

namespace tilepress {
namespace {

struct TextureTarget {
  GLenum bind;
  GLenum image;  // for queries: any face of a cube map
  bool multisampled;
  bool embedded;  // OpenGL ES has it
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

Result<ImageShape> shape_of(const Attachment& attachment, GLint width, GLint height, GLint samples) {
  if (width < 1 || height < 1) return unreadable("GL has no query for the size of the image");
  return ImageShape{{static_cast<uint32_t>(width), static_cast<uint32_t>(height), format_of(attachment.bits),
                     attachment.srgb},
                    samples};
}

}  // namespace

Result<ImageShape> shape_in_program_context(const GlFunctions& gl, const Attachment& attachment) {
  const ContextVersion version = version_of(gl);
  GLint width = 0, height = 0, samples = 0;
  if (version.embedded || version.number < 45 || gl.GetTextureLevelParameteriv == nullptr ||
      gl.GetNamedRenderbufferParameteriv == nullptr || gl.IsTexture == nullptr ||
      gl.IsRenderbuffer == nullptr)
    return unreadable("the program's context has no query for the size of its images");
  if (attachment.texture ? !gl.IsTexture(attachment.name) : !gl.IsRenderbuffer(attachment.name))
    return unreadable("the image is deleted");
  if (attachment.texture) {
    gl.GetTextureLevelParameteriv(attachment.name, attachment.level, GL_TEXTURE_WIDTH, &width);
    gl.GetTextureLevelParameteriv(attachment.name, attachment.level, GL_TEXTURE_HEIGHT, &height);
    gl.GetTextureLevelParameteriv(attachment.name, attachment.level, GL_TEXTURE_SAMPLES, &samples);
  } else {
    gl.GetNamedRenderbufferParameteriv(attachment.name, GL_RENDERBUFFER_WIDTH, &width);
    gl.GetNamedRenderbufferParameteriv(attachment.name, GL_RENDERBUFFER_HEIGHT, &height);
    gl.GetNamedRenderbufferParameteriv(attachment.name, GL_RENDERBUFFER_SAMPLES, &samples);
  }
  return shape_of(attachment, width, height, samples);
}

Result<ImageShape> shape_in_sharing_context(const GlFunctions& gl, const Attachment& attachment) {
  const ContextVersion version = version_of(gl);
  GLint width = 0, height = 0, samples = 0;
  gl.clear_errors();
  const bool exists = attachment.texture ? gl.IsTexture != nullptr && gl.IsTexture(attachment.name)
                                         : gl.IsRenderbuffer != nullptr && gl.IsRenderbuffer(attachment.name);
  if (!exists) return unreadable("the image is deleted");  // to bind its name would make another
  if (!attachment.texture) {
    gl.BindRenderbuffer(GL_RENDERBUFFER, attachment.name);
    gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_WIDTH, &width);
    gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_HEIGHT, &height);
    if (version.number >= 30)
      gl.GetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_SAMPLES, &samples);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
  } else if (gl.GetTexLevelParameteriv == nullptr || (version.embedded && version.number < 31)) {
    return unreadable("OpenGL ES before 3.1 has no query for the size of a texture");
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
  gl.clear_errors();
  return shape_of(attachment, width, height, samples);
}

}  // namespace tilepress
