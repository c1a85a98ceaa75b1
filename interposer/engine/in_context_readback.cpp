// In-context readback: what may be asked and set follows from the context's own version string, so that
// neither raises an error the program would find.
#include "interposer/engine/in_context_readback.h"

#include <GL/glext.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "interposer/engine/monotonic_clock.h"

namespace tilepress {
namespace {

struct ContextVersion {
  bool embedded = false;  // OpenGL ES
  int number = 0;         // 10 · major + minor
};

ContextVersion version_of(const GlFunctions& gl) {
  const auto* text = reinterpret_cast<const char*>(gl.GetString(GL_VERSION));
  ContextVersion version;
  if (text == nullptr) return version;
  version.embedded = strncmp(text, "OpenGL ES", 9) == 0;
  while (*text != 0 && (*text < '0' || *text > '9')) ++text;
  int major = 0, minor = 0;
  if (sscanf(text, "%d.%d", &major, &minor) == 2) version.number = 10 * major + minor;
  return version;
}

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

// Binds the window's own framebuffer and no pack buffer for reading, its back buffer selected; puts all back.
class BackBufferBinding {
 public:
  BackBufferBinding(const GlFunctions& gl, const ContextVersion& version, bool double_buffered) : gl_(gl) {
    const bool separate = version.number >= 30;
    target_ = separate ? GL_READ_FRAMEBUFFER : GL_FRAMEBUFFER;
    if (separate || version.embedded) {
      gl.GetIntegerv(separate ? GL_READ_FRAMEBUFFER_BINDING : GL_FRAMEBUFFER_BINDING, &framebuffer_);
      if (framebuffer_ != 0) gl.BindFramebuffer(target_, 0);
    }
    if (version.number >= (version.embedded ? 30 : 21)) {
      gl.GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack_buffer_);
      if (pack_buffer_ != 0) gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    }
    if (!version.embedded || version.number >= 30) {
      const GLint wanted = double_buffered || version.embedded ? GL_BACK : GL_FRONT;
      gl.GetIntegerv(GL_READ_BUFFER, &read_buffer_);
      restore_read_buffer_ = read_buffer_ != wanted;
      if (restore_read_buffer_) gl.ReadBuffer(static_cast<GLenum>(wanted));
    }
  }
  ~BackBufferBinding() {
    if (restore_read_buffer_) gl_.ReadBuffer(static_cast<GLenum>(read_buffer_));
    if (pack_buffer_ != 0) gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(pack_buffer_));
    if (framebuffer_ != 0) gl_.BindFramebuffer(target_, static_cast<GLuint>(framebuffer_));
  }
  BackBufferBinding(const BackBufferBinding&) = delete;
  BackBufferBinding& operator=(const BackBufferBinding&) = delete;

 private:
  const GlFunctions& gl_;
  GLenum target_ = GL_FRAMEBUFFER;
  bool restore_read_buffer_ = false;
  GLint framebuffer_ = 0, pack_buffer_ = 0, read_buffer_ = 0;
};

}  // namespace

bool in_program_context_only() {
  static const bool only = [] {
    const char* wish = getenv("TILEPRESS_READBACK");
    return wish != nullptr && strcmp(wish, "in-context") == 0;
  }();
  return only;
}

bool read_in_program_context(const GlFunctions& gl, const SurfaceShape& shape, bool double_buffered,
                             CapturedFrame& frame) {
  const ContextVersion version = version_of(gl);
  const bool eight_bits = *shape.format == PixelFormat::kRgba8 || *shape.format == PixelFormat::kRgbx8;
  if (version.number == 0 || gl.BindFramebuffer == nullptr || gl.BindBuffer == nullptr ||
      gl.ReadBuffer == nullptr)
    return false;
  if (!eight_bits && version.embedded)
    return false;  // ES allows other layouts only where it offers them itself
  GLint render_mode = GL_RENDER;
  if (!version.embedded && version.number < 31) gl.GetIntegerv(GL_RENDER_MODE, &render_mode);
  if (render_mode != GL_RENDER) return false;

  GLenum layout = GL_RGBA, type = GL_UNSIGNED_BYTE;
  size_t pixel_bytes = 4;
  if (*shape.format == PixelFormat::kRgb565) layout = GL_RGB, type = GL_UNSIGNED_SHORT_5_6_5, pixel_bytes = 2;
  if (*shape.format == PixelFormat::kRgb10a2) type = GL_UNSIGNED_INT_2_10_10_10_REV;
  const size_t pitch_bytes = size_t{shape.width} * pixel_bytes;
  std::byte* pixels = frame.reserve(pitch_bytes * shape.height);
  if (pixels == nullptr) return false;
  {
    const BackBufferBinding binding(gl, version, double_buffered);
    const PlainPackState pack(gl, version);
    const uint64_t begin_ns = now_ns();
    gl.ReadPixels(0, 0, static_cast<GLsizei>(shape.width), static_cast<GLsizei>(shape.height), layout, type,
                  pixels);
    frame.read_ns = now_ns() - begin_ns;
    frame.bind_ns = 0;
  }
  frame.view = {pixels + pitch_bytes * (shape.height - 1),
                -static_cast<ptrdiff_t>(pitch_bytes),
                shape.width,
                shape.height,
                *shape.format,
                ByteOrder::kRgba};
  return true;
}

}  // namespace tilepress
