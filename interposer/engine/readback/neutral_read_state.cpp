// Neutral read state: walks the table of read states. Finds out once per context which rows the context has.
#include "interposer/engine/readback/neutral_read_state.h"

#include <GL/glext.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "interposer/engine/readback/bound_framebuffer.h"

namespace tilepress {
namespace {

constexpr GLfloat kIdentity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// The rows of the table that a context has. Trivial, because each thread keeps one.
struct KnownContext {
  char version[128];
  const void* extensions;  ///< where the string lies; null in a core profile
  GLint extension_count;   ///< 0 unless a core profile
  GLint profile, flags;
  uint64_t rows;
};
static_assert(kReadStateCount <= 64);

bool is_legacy(const ContextVersion& version, const KnownContext& context, const char* extensions) {
  if (version.embedded) return false;
  if ((context.flags & GL_CONTEXT_FLAG_FORWARD_COMPATIBLE_BIT) != 0) return false;
  if (version.number == 31) return holds_extension(extensions, "GL_ARB_compatibility");
  return version.number < 31 || (context.profile & GL_CONTEXT_CORE_PROFILE_BIT) == 0;
}

std::string all_extensions(const GlFunctions& gl, const KnownContext& context) {
  if (context.extensions != nullptr) return static_cast<const char*>(context.extensions);
  std::string all;
  for (GLint i = 0; gl.GetStringi != nullptr && i < context.extension_count; ++i)
    if (const GLubyte* name = gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)))
      all.append(reinterpret_cast<const char*>(name)).append(" ");
  return all;
}

uint64_t rows_of(const ContextVersion& version, const KnownContext& context, const char* extensions) {
  const bool legacy = is_legacy(version, context, extensions);
  uint64_t rows = 0;
  for (size_t i = 0; i < kReadStateCount; ++i) {
    const read_state& state = kReadStates[i];
    const int since = version.embedded ? state.embedded : state.desktop;
    const bool has = (since != 0 && version.number >= since) || holds_extension(extensions, state.extensions);
    if (has && (legacy || state.legacy == 0)) rows |= uint64_t{1} << i;
  }
  return rows;
}

/// Recognises the thread's last context by the addresses of its strings and by its version. The version is
/// needed because a string of extensions may lie where another context's lay.
uint64_t rows_of_current(const GlFunctions& gl, const ContextVersion& version) {
  static thread_local KnownContext known;
  KnownContext now = {};
  const auto* text = reinterpret_cast<const char*>(gl.GetString(GL_VERSION));
  std::strncpy(now.version, text, sizeof now.version - 1);
  if (!version.embedded && version.number >= 32) gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &now.profile);
  if (!version.embedded && version.number >= 30) gl.GetIntegerv(GL_CONTEXT_FLAGS, &now.flags);
  const bool listed =
      !version.embedded && (version.number == 31 || (now.profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0 ||
                            (now.flags & GL_CONTEXT_FLAG_FORWARD_COMPATIBLE_BIT) != 0);
  if (listed)
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &now.extension_count);
  else
    now.extensions = gl.GetString(GL_EXTENSIONS);
  if (known.rows == 0 || std::strcmp(known.version, now.version) != 0 || known.extensions != now.extensions ||
      known.extension_count != now.extension_count || known.profile != now.profile ||
      known.flags != now.flags) {
    now.rows = rows_of(version, now, all_extensions(gl, now).c_str());
    known = now;
  }
  return known.rows;
}

}  // namespace

NeutralReadState::NeutralReadState(const GlFunctions& gl, const ContextVersion& version, GLuint framebuffer,
                                   GLenum buffer)
    : gl_(gl), version_(version), framebuffer_(framebuffer), buffer_(buffer) {
  const uint64_t rows = rows_of_current(gl, version);
  bool compiling = false;  // a display list
  for (size_t i = 0; i < kReadStateCount && whole_; ++i) {
    const read_state& state = kReadStates[i];
    if ((rows >> i & 1) == 0) continue;
    Saved saved{&state, 0, 0};
    if (is_neutral(saved)) continue;
    if (state.kind == kReadDisplayList) {
      compiling = true;
      continue;
    }
    const GLint value = state.kind == kReadFramebuffer ? static_cast<GLint>(framebuffer)
                        : state.kind == kReadBuffer    ? static_cast<GLint>(buffer)
                                                       : state.neutral;
    whole_ = (!compiling || state.kind == kReadPack || state.kind == kReadPackBuffer) &&
             set(state, value, static_cast<GLfloat>(state.neutral), kIdentity);
    if (whole_) saved_[saved_count_++] = saved;
  }
}

NeutralReadState::~NeutralReadState() {
  while (saved_count_ > 0) {
    const Saved& saved = saved_[--saved_count_];
    set(*saved.state, saved.value, saved.real, color_matrix_);
  }
}

bool NeutralReadState::is_neutral(Saved& saved) {
  const read_state& state = *saved.state;
  const GLint neutral = state.neutral;
  switch (state.kind) {
    case kReadCapability:
      saved.value = gl_.IsEnabled != nullptr && gl_.IsEnabled(state.gl_name) != GL_FALSE;
      return saved.value == neutral;
    case kReadTransferReal:
      if (gl_.GetFloatv != nullptr) gl_.GetFloatv(state.gl_name, &saved.real);
      return gl_.GetFloatv != nullptr && saved.real == static_cast<GLfloat>(neutral);
    case kReadColorMatrix:
      if (gl_.GetFloatv != nullptr) gl_.GetFloatv(state.gl_name, color_matrix_);
      return gl_.GetFloatv != nullptr && std::equal(kIdentity, kIdentity + 16, color_matrix_);
    case kReadFramebuffer:
      saved.value = static_cast<GLint>(bound_framebuffer(gl_, version_, FramebufferUse::kRead));
      return static_cast<GLuint>(saved.value) == framebuffer_;
    case kReadBuffer:
      gl_.GetIntegerv(state.gl_name, &saved.value);
      return static_cast<GLenum>(saved.value) == buffer_;
    default:
      gl_.GetIntegerv(state.gl_name, &saved.value);
      return saved.value == neutral;
  }
}

bool NeutralReadState::set(const read_state& state, GLint value, GLfloat real, const GLfloat* matrix) const {
  const auto number = static_cast<GLuint>(value);
  const auto call = [](auto function, auto... arguments) {
    if (function != nullptr) function(arguments...);
    return function != nullptr;
  };
  switch (state.kind) {
    case kReadDisplayList:
      break;
    case kReadCapability:
      return call(value != 0 ? gl_.Enable : gl_.Disable, state.gl_name);
    case kReadPack:
      return call(gl_.PixelStorei, state.gl_name, value);
    case kReadTransfer:
      return call(gl_.PixelTransferi, state.gl_name, value);
    case kReadTransferReal:
      return gl_.GetFloatv != nullptr && call(gl_.PixelTransferf, state.gl_name, real);
    case kReadColorMatrix: {
      if (gl_.GetFloatv == nullptr || gl_.MatrixMode == nullptr || gl_.LoadMatrixf == nullptr) return false;
      GLint mode = GL_MODELVIEW;
      gl_.GetIntegerv(GL_MATRIX_MODE, &mode);
      gl_.MatrixMode(GL_COLOR);
      gl_.LoadMatrixf(matrix);
      gl_.MatrixMode(static_cast<GLenum>(mode));
      break;
    }
    case kReadClamp:
      return call(gl_.ClampColor, state.gl_name, number);
    case kReadPackBuffer:
      return call(gl_.BindBuffer, GL_PIXEL_PACK_BUFFER, number);
    case kReadFramebuffer:
      return bind_framebuffer(gl_, version_, FramebufferUse::kRead, number);
    case kReadBuffer:
      return call(version_.embedded && version_.number < 30 ? gl_.ReadBufferNV : gl_.ReadBuffer, number);
  }
  return true;
}

}  // namespace tilepress
