// Capture, GL calls: frames that no presenting call ends: triggers (--trigger, OSMesa), and targets
// (--targets all).
#include <GL/gl.h>
#include <GL/glext.h>
#include <dlfcn.h>

#include <cstring>

#include "interposer/engine/readback/attachment_shape.h"
#include "interposer/engine/capture.h"
#include "interposer/engine/readback/in_context_readback.h"
#include "interposer/engine/monotonic_clock.h"
#include "interposer/engine/readback/resolve_readback.h"
#include "interposer/engine/readback/target_watch.h"

namespace tilepress {
namespace {

constexpr uintptr_t kNameMask = uintptr_t{1} << 63 | 0xFFFFFFFFu;  // of Attachment::image()

bool is_trigger(uint32_t kind) {
  return kind == TILEPRESS_GL_FINISH || kind == TILEPRESS_GL_FLUSH || kind == TILEPRESS_GL_READ_PIXELS;
}

const char* cause_of(uint32_t kind) {
  return kind == TILEPRESS_GL_FINISH ? "finish" : kind == TILEPRESS_GL_FLUSH ? "flush" : "readpixels";
}

/// What a call that ends a frame is about: what the context reads from, or draws to.
FramebufferUse use_of(uint32_t kind) {
  return kind == TILEPRESS_GL_READ_PIXELS ? FramebufferUse::kRead : FramebufferUse::kDraw;
}

uint64_t pixel_hash(const CapturedFrame& frame) {
  const SurfaceView& view = frame.view;
  const size_t row_bytes = size_t{view.width} * traits(view.format).pixel_bits / 8;
  uint64_t hash = 0x9E3779B97F4A7C15u;
  for (uint32_t y = 0; y < view.height; ++y) {
    const std::byte* row = view.top_row + static_cast<ptrdiff_t>(y) * view.pitch_bytes;
    for (size_t at = 0; at < row_bytes; at += 8) {
      uint64_t word = 0;
      memcpy(&word, row + at, std::min<size_t>(8, row_bytes - at));
      hash = (hash ^ word) * 0xFF51AFD7ED558CCDu;
      hash ^= hash >> 32;
    }
  }
  return hash;
}

/// An image, and what could be learned of it.
struct Measured {
  Attachment attachment;
  SurfaceShape shape;
  GLint samples;
  bool known;
  std::string reason;
};

/// By default both glFlush and glFinish end a frame of an OSMesa program: one that calls both in a row, with
/// nothing drawn between, has ended one.
bool is_second_of_pair(uint32_t kind, const CapturedFrame& frame) {
  thread_local struct {
    uint32_t kind = TILEPRESS_GL_KINDS;
    uint64_t hash = 0;
  } last;
  const uint64_t hash = pixel_hash(frame);
  const bool second = last.kind != TILEPRESS_GL_KINDS && last.kind != kind && last.hash == hash;
  last.kind = second ? uint32_t{TILEPRESS_GL_KINDS} : kind;
  last.hash = hash;
  return second;
}

/// A multisampled image, which no context reads as it is.
bool read_beside(PresentSource& source, const TilepressPresent& present, const Attachment& image,
                 const SurfaceShape& shape, CapturedFrame& frame, std::string& reason) {
  if (in_program_context_only()) {
    reason = "a multisampled image is resolved in a private context alone";
    return false;
  }
  const uint64_t begin_ns = now_ns();
  uint64_t inside_ns = 0;
  bool read = false;
  const auto work = [&] {
    const uint64_t bound_ns = now_ns();
    read = read_resolved(source.gl(), image, shape, frame, reason);
    inside_ns = now_ns() - bound_ns;
  };
  const bool ran = source.beside(present, work, reason);
  frame.bind_ns = now_ns() - begin_ns - inside_ns;
  return ran && read;
}

/// Where both roads are open, a call that came along the first comes along the second too: it is one frame.
bool comes_again(const TilepressGlCall& call) {
  thread_local uint32_t awaited = TILEPRESS_GL_KINDS;
  if (call.osmesa != nullptr) return false;
  const bool again = call.road == TILEPRESS_ROAD_GLVND && awaited == call.kind;
  awaited = call.road == TILEPRESS_ROAD_GLVND ? uint32_t{TILEPRESS_GL_KINDS} : call.kind;
  return again;
}

}  // namespace

void* Capture::public_function(uint32_t api) {
  if (void* known = public_[api]) return known;
  static constexpr const char* kLibraries[][2] = {{"libEGL.so.1", nullptr}, {"libGLX.so.0", "libGL.so.1"}};
  for (const char* library : kLibraries[api]) {
    void* handle = library != nullptr ? dlopen(library, RTLD_LAZY | RTLD_NOLOAD) : nullptr;
    if (handle == nullptr) continue;
    public_[api] = host_.dlsym(handle, api == TILEPRESS_EGL ? "eglSwapBuffers" : "glXSwapBuffers");
    dlclose(handle);
    if (void* found = public_[api]) return found;
  }
  dlerror();
  return nullptr;
}

PresentSource* Capture::source_of(const TilepressGlCall& call, TilepressPresent& present) {
  present = {};
  present.road = call.road;
  present.context_destroyed = call.context_destroyed;
  const FramebufferUse use = use_of(call.kind);
  const auto is_current = [&](uint32_t api, void* real) -> PresentSource* {
    present.api = api;
    present.real = real;
    present.look_up = call.look_up[api];
    PresentSource* source = real != nullptr ? source_of(present) : nullptr;
    return source != nullptr && source->find_current(present, use) ? source : nullptr;
  };
  if (PresentSource* source = is_current(TILEPRESS_OSMESA, call.osmesa)) return source;
  // On a driver's own road the driver says what is current, else the libraries that programs call.
  const bool driver = call.look_up[TILEPRESS_EGL] != nullptr || call.look_up[TILEPRESS_GLX] != nullptr;
  for (const uint32_t api : {TILEPRESS_EGL, TILEPRESS_GLX}) {
    const auto look_up = call.look_up[api];
    void* real = look_up != nullptr ? look_up(api == TILEPRESS_EGL ? "eglSwapBuffers" : "glXSwapBuffers")
                 : driver           ? nullptr
                                    : public_function(api);
    if (PresentSource* source = is_current(api, real)) return source;
  }
  return nullptr;
}

void Capture::gl_call(const TilepressGlCall& call) {
  if (!is_capturing()) return;
  const bool deletes =
      call.kind == TILEPRESS_GL_DELETE_TEXTURES || call.kind == TILEPRESS_GL_DELETE_RENDERBUFFERS;
  if (!is_trigger(call.kind) && !concerns_targets(call) && !deletes) return;
  if (is_trigger(call.kind) && comes_again(call)) return;
  TilepressPresent present;
  PresentSource* source = source_of(call, present);
  if (source == nullptr) return;
  const uint32_t error = source->take_error();
  if (is_trigger(call.kind)) {
    trigger(call, present, *source);
  } else {
    const void* context = source->context();
    take_attachments(present, *source, targets_left_by(source->gl(), call, context), FramebufferUse::kDraw,
                     SurfaceRole::kTarget, "target");
    const auto count = static_cast<int32_t>(call.arguments[0]);
    const auto* names = reinterpret_cast<const GLuint*>(call.arguments[1]);
    for (int32_t i = 0; deletes && names != nullptr && i < count; ++i) {
      Attachment gone;
      gone.texture = call.kind == TILEPRESS_GL_DELETE_TEXTURES;
      gone.name = names[i];
      forget_targets(context, gone.image(), kNameMask);
    }
  }
  source->put_back_error(error);
}

void Capture::trigger(const TilepressGlCall& call, const TilepressPresent& present, PresentSource& source) {
  const FramebufferUse use = use_of(call.kind);
  const GlFunctions& gl = source.gl();
  const ContextVersion version = version_of(gl);
  if (bound_framebuffer(gl, version, use) == 0) return take_default_framebuffer(call, present, source, use);
  if (!is_complete(gl, version, use)) return;
  std::vector<Attachment> attachments;
  for (const GLenum point : buffers_in_use(gl, version, use))
    if (Attachment attachment; describe_attachment(gl, version, use, point, attachment))
      attachments.push_back(attachment);
  take_attachments(present, source, attachments, use, SurfaceRole::kPresented, cause_of(call.kind));
}

void Capture::take_default_framebuffer(const TilepressGlCall& call, const TilepressPresent& present,
                                       PresentSource& source, FramebufferUse use) {
  const std::vector<GLenum> buffers = buffers_in_use(source.gl(), version_of(source.gl()), use);
  Shot shot;
  shot.begin_ns = now_ns();
  shot.cause = cause_of(call.kind);
  if (present.api == TILEPRESS_OSMESA) shot.origin = "buffer";
  std::string reason;
  if (buffers.empty() || !source.describe(present, shot.key, shot.shape, reason)) {
    log_->write(LogLevel::kDebug, std::string(shot.cause) + ": " + reason);
    return;
  }
  shot.software_window = shot.shape.resizable && source.draws_in_software();
  const bool front = buffers[0] == GL_FRONT || buffers[0] == GL_FRONT_LEFT;
  shot.read = [&](CapturedFrame& frame, std::string& why) {
    if (!front) return source.read(present, shot.shape, frame, why);
    return source.read_in_place(present, shot.shape, buffers[0], frame, why);
  };
  CaptureWorker* made = worker(present, source);
  Take taken = take(shot, *made);
  taken.triggered = true;
  if (call.by_default && taken.frame != nullptr && is_second_of_pair(call.kind, *taken.frame))
    return made->queue().release(taken.frame);
  commit(taken);
}

void Capture::take_attachments(const TilepressPresent& present, PresentSource& source,
                               const std::vector<Attachment>& attachments, FramebufferUse use,
                               SurfaceRole role, const char* cause) {
  if (attachments.empty()) return;
  CaptureWorker* made = worker(present, source);
  counts_.roads |= 1u << present.road;
  if (!enabled_) return;
  const GlFunctions& gl = source.gl();
  const uint64_t begin_ns = now_ns();
  std::vector<Measured> images;
  for (const Attachment& attachment : attachments) {
    Measured& image = images.emplace_back(Measured{attachment, {}, 0, false, ""});
    image.known = shape_in_program_context(gl, attachment, image.shape, image.samples);
  }
  const auto measure = [&] {
    for (Measured& image : images)
      image.known = shape_in_sharing_context(gl, image.attachment, image.shape, image.samples, image.reason);
  };
  std::string reason = "the program's context does not tell the size of its images";
  if (!images[0].known && (in_program_context_only() || !source.beside(present, measure, reason)))
    for (Measured& image : images) image.reason = reason;
  for (const Measured& image : images) {
    Shot shot;
    shot.begin_ns = images.size() == 1 ? begin_ns : now_ns();
    shot.cause = cause;
    shot.key = {source.context(), image.attachment.image(), role};
    shot.origin = image.attachment.text();
    if (image.known) shot.shape = image.shape;
    const bool multisampled = image.samples > 0;
    if (multisampled) shot.origin += " resolved";
    shot.read = [&](CapturedFrame& frame, std::string& why) {
      if (multisampled) return read_beside(source, present, image.attachment, image.shape, frame, why);
      why = "the program's context cannot be read";
      frame.way = ReadWay::kInContext;
      return read_attachment_in_program_context(gl, image.attachment, use, image.shape, frame);
    };
    commit(image.known ? take(shot, *made) : miss(shot, image.reason));
  }
}

Capture::Take Capture::miss(const Shot& shot, const std::string& reason) {
  const SurfaceRegistry::Turn turn = registry_.turn(shot.key, shot.shape, shot.begin_ns);
  report(turn.surface, "not captured: " + shot.origin + ": " + reason);
  return {Outcome::kNotCaptured, shot.key.role, turn.window, nullptr, shot.begin_ns};
}

}  // namespace tilepress
