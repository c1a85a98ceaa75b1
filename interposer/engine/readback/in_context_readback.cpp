// In-context readback: the context's own version string says which queries and states it has, so that no call
// raises an error that the program would find.
#include "interposer/engine/readback/in_context_readback.h"

#include <cstring>
#include <optional>

#include "interposer/engine/readback/neutral_read_state.h"
#include "interposer/engine/readback/transfer.h"
#include "interposer/engine/source/context_version.h"
#include "interposer/system_calls.h"

namespace tilepress {
namespace {

// For the buffer that is bound. Empty if this context does not read the format: OpenGL ES reads 8-bit RGBA,
// and one other format that it names itself.
std::optional<Transfer> transfer_of(const GlFunctions& gl, const ContextVersion& version,
                                    PixelFormat format) {
  GLint offered_format = GL_BGRA, offered_type = GL_UNSIGNED_BYTE;  // any desktop GL reads it
  if (version.number >= (version.embedded ? 20 : 41)) {
    gl.GetIntegerv(GL_IMPLEMENTATION_COLOR_READ_FORMAT, &offered_format);
    gl.GetIntegerv(GL_IMPLEMENTATION_COLOR_READ_TYPE, &offered_type);
  } else if (version.embedded) {
    offered_format = GL_RGBA;
  }
  const Transfer transfer = tilepress::transfer_of(format, offered_format, offered_type);
  const bool offered = static_cast<GLenum>(offered_format) == transfer.format &&
                       static_cast<GLenum>(offered_type) == transfer.type;
  const bool bytes = transfer.format == GL_RGBA && transfer.type == GL_UNSIGNED_BYTE;
  return !version.embedded || bytes || offered ? std::optional(transfer) : std::nullopt;
}

bool read_bound(const GlFunctions& gl, const ContextVersion& version, const SurfaceShape& shape,
                CapturedFrame& frame) {
  const std::optional<Transfer> transfer = transfer_of(gl, version, *shape.format);
  if (!transfer) return false;
  std::byte* pixels = frame.reserve(shape, transfer->pixel_bytes, transfer->order);
  if (pixels == nullptr) return false;
  if (frame.partial) std::memset(pixels, 0, size_t{shape.width} * shape.height * transfer->pixel_bytes);
  const uint64_t begin_ns = now_ns();
  gl.ReadPixels(0, 0, static_cast<GLsizei>(shape.width), static_cast<GLsizei>(shape.height), transfer->format,
                transfer->type, pixels);
  frame.read_ns = now_ns() - begin_ns;
  frame.bind_ns = 0;
  return true;
}

bool read_neutrally(const GlFunctions& gl, const ContextVersion& version, GLuint framebuffer, GLenum buffer,
                    const SurfaceShape& shape, CapturedFrame& frame) {
  const NeutralReadState neutral(gl, version, framebuffer, buffer);
  return neutral.whole() && read_bound(gl, version, shape, frame);
}

}  // namespace

bool read_in_program_context(const GlFunctions& gl, const SurfaceShape& shape, GLenum buffer,
                             CapturedFrame& frame) {
  const ContextVersion version = version_of(gl);
  return version.number != 0 && read_neutrally(gl, version, 0, buffer, shape, frame);
}

bool read_attachment_in_program_context(const GlFunctions& gl, const Attachment& attachment,
                                        FramebufferUse use, const SurfaceShape& shape, CapturedFrame& frame) {
  const ContextVersion version = version_of(gl);
  return version.number != 0 &&
         read_neutrally(gl, version, bound_framebuffer(gl, version, use), attachment.point, shape, frame);
}

}  // namespace tilepress
