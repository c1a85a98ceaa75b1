// Target capture: measures images, takes a shot of each, and commits it at once.
#include "interposer/engine/target_capture.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <cstring>

#include "interposer/engine/readback/attachment_shape.h"
#include "interposer/engine/readback/target_watch.h"
#include "interposer/system_calls.h"

namespace tilepress {
namespace {

constexpr uintptr_t kNameMask =
    uintptr_t{1} << 63 | 0xFFFFFFFFu;  // the bits of a name in Attachment::image()

constexpr uint32_t kNoKind = TILEPRESS_GL_KINDS;

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

/// `kind`: enum TilepressGlKind.
bool is_trigger(uint32_t kind) {
  return kind == TILEPRESS_GL_FINISH || kind == TILEPRESS_GL_FLUSH || kind == TILEPRESS_GL_READ_PIXELS;
}

/// The name of a trigger in presents.csv: "finish", "flush" or "readpixels".
const char* cause_of(uint32_t kind) {
  return kind == TILEPRESS_GL_FINISH ? "finish" : kind == TILEPRESS_GL_FLUSH ? "flush" : "readpixels";
}

/// The framebuffer whose frame the call ends: glReadPixels ends the one it reads, the others the one drawn
/// to.
FramebufferUse use_of(uint32_t kind) {
  return kind == TILEPRESS_GL_READ_PIXELS ? FramebufferUse::kRead : FramebufferUse::kDraw;
}

/// Where both roads are open, a trigger comes along the preload road first and then along libglvnd's. Returns
/// true for the second time. Keeps its state per thread.
bool comes_again(const TilepressGlCall& call) {
  thread_local uint32_t awaited = kNoKind;
  if (call.osmesa != nullptr) return false;
  const bool glvnd = call.road == TILEPRESS_ROAD_GLVND;
  const bool again = glvnd && awaited == call.kind;
  awaited = glvnd ? kNoKind : call.kind;
  return again;
}

/// By default both glFlush and glFinish end a frame of an OSMesa program. Returns true if `frame` ends with
/// the second of the two and the same pixels, so nothing was drawn in between. Keeps its state per thread.
bool is_second_of_pair(uint32_t kind, const CapturedFrame& frame) {
  thread_local struct {
    uint32_t kind = kNoKind;
    uint64_t hash = 0;
  } last;
  const uint64_t hash = pixel_hash(frame);
  const bool second = last.kind != kNoKind && last.kind != kind && last.hash == hash;
  last.kind = second ? kNoKind : kind;
  last.hash = hash;
  return second;
}

bool deletes_images(uint32_t kind) {
  return kind == TILEPRESS_GL_DELETE_TEXTURES || kind == TILEPRESS_GL_DELETE_RENDERBUFFERS;
}

/// Queries all sizes in the program's context. If that context has no query for the first one, queries them
/// in a private context that shares its objects.
std::vector<Result<ImageShape>> measure(const TilepressPresent& present, PresentSource& source,
                                        const std::vector<Attachment>& images) {
  std::vector<Result<ImageShape>> shapes;
  for (const Attachment& image : images) shapes.push_back(shape_in_program_context(source.gl(), image));
  if (shapes[0]) return shapes;
  const Result<void> ran = source.beside(present, [&] {
    for (size_t i = 0; i < images.size(); ++i) shapes[i] = shape_in_sharing_context(source.gl(), images[i]);
  });
  for (Result<ImageShape>& shape : shapes)
    if (!ran && !shape) shape = ran.error();
  return shapes;
}

}  // namespace

void TargetCapture::gl_call(const TilepressGlCall& call) {
  const bool ends_frame = is_trigger(call.kind);
  if (ends_frame ? comes_again(call) : !concerns_targets(call) && !deletes_images(call.kind)) return;
  TilepressPresent present;
  PresentSource* source = sources_.of_current(call, use_of(call.kind), present);
  if (source == nullptr) return;
  const uint32_t error = source->take_error();
  if (ends_frame)
    end_frame(call, present, *source);
  else
    leave_targets(call, present, *source);
  source->put_back_error(error);
}

void TargetCapture::end_frame(const TilepressGlCall& call, const TilepressPresent& present,
                              PresentSource& source) {
  const FramebufferUse use = use_of(call.kind);
  const GlFunctions& gl = source.gl();
  const ContextVersion version = version_of(gl);
  if (bound_framebuffer(gl, version, use) == 0) return take_default_framebuffer(call, present, source);
  if (!is_complete(gl, version, use)) return;
  std::vector<Attachment> images;
  for (const GLenum point : buffers_in_use(gl, version, use))
    if (Attachment image; describe_attachment(gl, version, use, point, image)) images.push_back(image);
  take_images(present, source, images, use, SurfaceRole::kPresented, cause_of(call.kind));
}

void TargetCapture::take_default_framebuffer(const TilepressGlCall& call, const TilepressPresent& present,
                                             PresentSource& source) {
  const FramebufferUse use = use_of(call.kind);
  const char* cause = cause_of(call.kind);
  const std::vector<GLenum> buffers = buffers_in_use(source.gl(), version_of(source.gl()), use);
  const uint64_t begin_ns = now_ns();
  if (buffers.empty()) return log_.debug(std::string(cause) + ": no buffer is in use");
  const Result<Drawable> drawable = source.describe(present);
  if (!drawable) return log_.debug(about(cause, drawable.error()).text);
  CaptureWorker* worker = run_.worker(present, source);
  if (worker == nullptr) return;
  const ShotBuilder shots(source, present);
  Take take = taker_.take(shots.of_buffer(*drawable, buffers[0], cause, begin_ns), *worker);
  take.triggered = true;
  if (call.by_default && take.frame != nullptr && is_second_of_pair(call.kind, *take.frame))
    taker_.discard(take, *worker);
  else
    taker_.commit(take, *worker);
}

void TargetCapture::leave_targets(const TilepressGlCall& call, const TilepressPresent& present,
                                  PresentSource& source) {
  const void* context = source.context();
  take_images(present, source, targets_left_by(source.gl(), call, context), FramebufferUse::kDraw,
              SurfaceRole::kTarget, "target");
  if (!deletes_images(call.kind)) return;
  const auto count = static_cast<int32_t>(call.arguments[0]);
  const auto* names = reinterpret_cast<const GLuint*>(call.arguments[1]);
  for (int32_t i = 0; names != nullptr && i < count; ++i) {
    Attachment gone;
    gone.texture = call.kind == TILEPRESS_GL_DELETE_TEXTURES;
    gone.name = names[i];
    forget(context, gone.image(), kNameMask);
  }
}

void TargetCapture::take_targets(const TilepressPresent& present, PresentSource& source) {
  if (source.context() == nullptr) return;
  take_images(present, source, targets_left(source.gl()), FramebufferUse::kDraw, SurfaceRole::kTarget,
              "target");
}

void TargetCapture::take_images(const TilepressPresent& present, PresentSource& source,
                                const std::vector<Attachment>& images, FramebufferUse use, SurfaceRole role,
                                const char* cause) {
  if (images.empty()) return;
  CaptureWorker* worker = run_.worker(present, source);
  if (worker == nullptr) return;
  const uint64_t begin_ns = now_ns();
  const std::vector<Result<ImageShape>> shapes = measure(present, source, images);
  const ShotBuilder shots(source, present);
  for (size_t i = 0; i < images.size(); ++i) {
    const uint64_t image_ns = images.size() == 1 ? begin_ns : now_ns();
    const Shot shot = shots.of_image(images[i], shapes[i], use, role, cause, image_ns);
    taker_.commit(shapes[i] ? taker_.take(shot, *worker) : taker_.miss(shot, shapes[i].error()), *worker);
  }
}

void TargetCapture::forget(const void* context, uintptr_t image, uintptr_t mask) {
  CaptureWorker* worker = run_.worker_if_started();
  for (const uint32_t window : registry_.forget_targets(context, image, mask))
    if (worker != nullptr) worker->queue().submit_end_of(window);
}

}  // namespace tilepress
