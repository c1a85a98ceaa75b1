// Resolve readback: calls glBlitFramebuffer, as a program would. The private context has none of the state
// that a blit heeds: no scissor, no conditional rendering.
#include "interposer/engine/readback/resolve_readback.h"

#include <GL/glext.h>

#include "interposer/engine/readback/in_context_readback.h"
#include "interposer/engine/readback/target_watch.h"

namespace tilepress {
namespace {

GLenum storage_format(const SurfaceShape& shape) {
  switch (*shape.format) {
    case PixelFormat::kRgbx8:
      return GL_RGB8;
    case PixelFormat::kRgb565:
      return GL_RGB565;
    case PixelFormat::kRgb10a2:
      return GL_RGB10_A2;
    case PixelFormat::kRgba16f:
      return GL_RGBA16F;
    default:
      return shape.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8;
  }
}

// Two framebuffers and a renderbuffer for one blit. They live no longer, because Mesa shares even the names
// of framebuffers with the program.
class ResolveObjects {
 public:
  explicit ResolveObjects(const GlFunctions& gl) : gl_(gl) {
    gl.GenFramebuffers(2, framebuffers_);
    gl.GenRenderbuffers(1, &storage_);
  }
  ~ResolveObjects() {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl_.DeleteFramebuffers(2, framebuffers_);
    gl_.DeleteRenderbuffers(1, &storage_);
  }
  ResolveObjects(const ResolveObjects&) = delete;
  ResolveObjects& operator=(const ResolveObjects&) = delete;

  void draw_to_image_of(const SurfaceShape& shape) const {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, storage_);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, storage_format(shape), static_cast<GLsizei>(shape.width),
                            static_cast<GLsizei>(shape.height));
    gl_.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[0]);
    gl_.FramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, storage_);
  }
  /// Returns false if GL does not say which layer of an array the image is.
  bool read_from(const Attachment& image) const {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
    if (!image.texture) {
      gl_.FramebufferRenderbuffer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, image.name);
      return true;
    }
    gl_.clear_errors();
    gl_.FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, image.name,
                             0);
    if (gl_.GetError() == GL_NO_ERROR) return true;
    const bool certain = image.layer != 0 || reports_layers(image.name);
    gl_.FramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, image.name, 0, image.layer);
    return certain;
  }
  void read_what_was_drawn() const { gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[0]); }

 private:
  /// Mesa answers 0 for every layer of a multisampled array.
  bool reports_layers(GLuint array) const {
    GLint layers = 0, layer = 0;
    if (gl_.BindTexture == nullptr || gl_.GetTexLevelParameteriv == nullptr) return false;
    gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, array);
    gl_.GetTexLevelParameteriv(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, 0, GL_TEXTURE_DEPTH, &layers);
    gl_.BindTexture(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, 0);
    if (layers == 1) return true;
    gl_.FramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, array, 0, 1);
    gl_.GetFramebufferAttachmentParameteriv(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                            GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LAYER, &layer);
    return layer == 1;
  }
  const GlFunctions& gl_;
  GLuint framebuffers_[2] = {};
  GLuint storage_ = 0;
};

bool can_resolve(const GlFunctions& gl) {
  return version_of(gl).separate_framebuffers() && gl.GenFramebuffers != nullptr &&
         gl.DeleteFramebuffers != nullptr && gl.FramebufferRenderbuffer != nullptr &&
         gl.FramebufferTexture2D != nullptr && gl.FramebufferTextureLayer != nullptr &&
         gl.GenRenderbuffers != nullptr && gl.DeleteRenderbuffers != nullptr &&
         gl.BindRenderbuffer != nullptr && gl.RenderbufferStorage != nullptr && gl.BlitFramebuffer != nullptr;
}

void blit(const GlFunctions& gl, const SurfaceShape& shape) {
  const auto width = static_cast<GLint>(shape.width), height = static_cast<GLint>(shape.height);
  const uint8_t mark = *drawn_mark();  // our call may come along the second road, as if the program drew
  gl.BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  *drawn_mark() = mark;
}

}  // namespace

Result<void> read_resolved(const GlFunctions& gl, const Attachment& attachment, const SurfaceShape& shape,
                           CapturedFrame& frame) {
  const Error failed = unreadable("the image cannot be resolved");
  if (!can_resolve(gl)) return failed;
  const ResolveObjects objects(gl);
  objects.draw_to_image_of(shape);
  if (!objects.read_from(attachment))
    return unreadable("the driver does not say which layer of the array is drawn");
  gl.clear_errors();
  blit(gl, shape);
  if (gl.GetError() != GL_NO_ERROR) return failed;
  objects.read_what_was_drawn();
  Attachment resolved;
  resolved.point = GL_COLOR_ATTACHMENT0;
  const bool read = read_attachment_in_program_context(gl, resolved, FramebufferUse::kRead, shape, frame);
  if (!read || gl.GetError() != GL_NO_ERROR) return failed;
  return {};
}

bool with_back_buffer(const GlFunctions& gl, const SurfaceShape& shape, const std::function<bool()>& read) {
  // Drivers have crashed on a read with READ_BUFFER = NONE. A fresh context has GL_BACK on a window, but
  // perhaps not on other surfaces.
  if (gl.ReadBuffer != nullptr) gl.ReadBuffer(GL_BACK);
  GLint multisampled = 0;
  gl.GetIntegerv(GL_SAMPLE_BUFFERS, &multisampled);
  if (multisampled == 0 || !can_resolve(gl)) return read();
  const ResolveObjects objects(gl);
  objects.draw_to_image_of(shape);
  blit(gl, shape);
  objects.read_what_was_drawn();
  return gl.GetError() == GL_NO_ERROR && read();
}

}  // namespace tilepress
