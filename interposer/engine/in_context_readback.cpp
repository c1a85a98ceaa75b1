// In-context readback: what may be asked and set follows from the context's own version string, so that
// neither raises an error the program would find.
#include "interposer/engine/in_context_readback.h"

#include <cstdlib>
#include <cstring>
#include <optional>
#include <vector>

#include "interposer/engine/context_version.h"
#include "interposer/engine/monotonic_clock.h"
#include "interposer/engine/transfer.h"

namespace tilepress {
namespace {

// Sets pack parameters to the plain layout and puts them back.
class PlainPackState {
 public:
  PlainPackState(const GlFunctions& gl, const ContextVersion& version) : gl_(gl) {
    set(GL_PACK_ALIGNMENT, 1);
    if (!version.embedded || version.number >= 30)
      for (const GLenum name : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS}) set(name, 0);
    if (!version.embedded)
      for (const GLenum name :
           {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_IMAGES})
        set(name, 0);
  }
  ~PlainPackState() {
    for (const Saved& saved : saved_) gl_.PixelStorei(saved.name, saved.value);
  }
  PlainPackState(const PlainPackState&) = delete;
  PlainPackState& operator=(const PlainPackState&) = delete;

 private:
  struct Saved {
    GLenum name;
    GLint value;
  };
  void set(GLenum name, GLint value) {
    GLint before = 0;
    gl_.GetIntegerv(name, &before);
    if (before == value) return;
    saved_.push_back({name, before});
    gl_.PixelStorei(name, value);
  }
  const GlFunctions& gl_;
  std::vector<Saved> saved_;
};

// Binds a framebuffer and no pack buffer for reading, with a buffer of it selected; puts all back.
class ReadBinding {
 public:
  ReadBinding(const GlFunctions& gl, const ContextVersion& version, GLuint framebuffer, GLenum buffer)
      : gl_(gl) {
    const bool separate = version.separate_framebuffers();
    target_ = separate ? GL_READ_FRAMEBUFFER : GL_FRAMEBUFFER;
    before_ = bound_framebuffer(gl, version, FramebufferUse::kRead);
    bound_ = framebuffer;
    if (before_ != bound_) gl.BindFramebuffer(target_, bound_);
    if (version.number >= (version.embedded ? 30 : 21)) {
      gl.GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack_buffer_);
      if (pack_buffer_ != 0) gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    }
    if (!version.embedded || version.number >= 30) {
      gl.GetIntegerv(GL_READ_BUFFER, &read_buffer_);
      restore_read_buffer_ = static_cast<GLenum>(read_buffer_) != buffer;
      if (restore_read_buffer_) gl.ReadBuffer(buffer);
    }
  }
  ~ReadBinding() {
    if (restore_read_buffer_) gl_.ReadBuffer(static_cast<GLenum>(read_buffer_));
    if (pack_buffer_ != 0) gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(pack_buffer_));
    if (before_ != bound_) gl_.BindFramebuffer(target_, before_);
  }
  ReadBinding(const ReadBinding&) = delete;
  ReadBinding& operator=(const ReadBinding&) = delete;

 private:
  const GlFunctions& gl_;
  GLenum target_ = GL_FRAMEBUFFER;
  bool restore_read_buffer_ = false;
  GLuint before_ = 0, bound_ = 0;
  GLint pack_buffer_ = 0, read_buffer_ = 0;
};

// The program's debug callback hears of its own calls alone: a driver has something to say of slow reads.
class QuietDebugOutput {
 public:
  QuietDebugOutput(const GlFunctions& gl, const ContextVersion& version) : gl_(gl) {
    const bool known = version.number >= (version.embedded ? 32 : 43) && gl.IsEnabled != nullptr &&
                       gl.Enable != nullptr && gl.Disable != nullptr;
    was_on_ = known && gl.IsEnabled(GL_DEBUG_OUTPUT) != GL_FALSE;
    if (was_on_) gl.Disable(GL_DEBUG_OUTPUT);
  }
  ~QuietDebugOutput() {
    if (was_on_) gl_.Enable(GL_DEBUG_OUTPUT);
  }
  QuietDebugOutput(const QuietDebugOutput&) = delete;
  QuietDebugOutput& operator=(const QuietDebugOutput&) = delete;

 private:
  const GlFunctions& gl_;
  bool was_on_ = false;
};

// Of the buffer that is bound; empty where this context does not read its format. OpenGL ES reads 8-bit RGBA,
// and what else it offers itself.
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
  const size_t pitch_bytes = size_t{shape.width} * transfer->pixel_bytes;
  std::byte* pixels = frame.reserve(pitch_bytes * shape.height);
  if (pixels == nullptr) return false;
  if (frame.partial) std::memset(pixels, 0, pitch_bytes * shape.height);
  const PlainPackState pack(gl, version);
  const uint64_t begin_ns = now_ns();
  gl.ReadPixels(0, 0, static_cast<GLsizei>(shape.width), static_cast<GLsizei>(shape.height), transfer->format,
                transfer->type, pixels);
  frame.read_ns = now_ns() - begin_ns;
  frame.bind_ns = 0;
  frame.view = {pixels + pitch_bytes * (shape.height - 1),
                -static_cast<ptrdiff_t>(pitch_bytes),
                shape.width,
                shape.height,
                *shape.format,
                transfer->order};
  return true;
}

bool can_read(const GlFunctions& gl, const ContextVersion& version) {
  const bool selects = !version.embedded || version.number >= 30;
  if (version.number == 0 || gl.BindFramebuffer == nullptr || gl.BindBuffer == nullptr ||
      (selects && gl.ReadBuffer == nullptr))
    return false;
  GLint render_mode = GL_RENDER;
  if (!version.embedded && version.number < 31) gl.GetIntegerv(GL_RENDER_MODE, &render_mode);
  return render_mode == GL_RENDER;
}

}  // namespace

bool in_program_context_only() {
  static const bool only = [] {
    const char* wish = getenv("TILEPRESS_READBACK");
    return wish != nullptr && strcmp(wish, "in-context") == 0;
  }();
  return only;
}

bool read_in_program_context(const GlFunctions& gl, const SurfaceShape& shape, GLenum buffer,
                             CapturedFrame& frame) {
  const ContextVersion version = version_of(gl);
  if (!can_read(gl, version)) return false;
  const QuietDebugOutput quiet(gl, version);
  const ReadBinding binding(gl, version, 0, buffer);
  return read_bound(gl, version, shape, frame);
}

bool read_attachment_in_program_context(const GlFunctions& gl, const Attachment& attachment,
                                        FramebufferUse use, const SurfaceShape& shape, CapturedFrame& frame) {
  const ContextVersion version = version_of(gl);
  if (!can_read(gl, version)) return false;
  const QuietDebugOutput quiet(gl, version);
  const ReadBinding binding(gl, version, bound_framebuffer(gl, version, use), attachment.point);
  return read_bound(gl, version, shape, frame);
}

}  // namespace tilepress
