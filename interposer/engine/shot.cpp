// Shot: drawables are read by their source, images in the program's context or, multisampled, beside it.
#include "interposer/engine/shot.h"

#include "interposer/engine/readback/in_context_readback.h"
#include "interposer/engine/readback/resolve_readback.h"
#include "interposer/system_calls.h"

namespace tilepress {

static std::string damage_text(const TilepressPresent& present) {
  std::string text;
  for (int32_t i = 0; present.damage != nullptr && i < 4 * present.damage_count; ++i)
    (text += i % 4 == 0 ? ';' : ' ') += std::to_string(present.damage[i]);
  return text.empty() ? text : text.substr(1);
}

Shot ShotBuilder::of_drawable(const Drawable& drawable, uint64_t begin_ns) const {
  Shot shot;
  shot.key = drawable.key;
  shot.shape = drawable.shape;
  shot.origin = present_.api == TILEPRESS_OSMESA ? "buffer" : "window";
  shot.begin_ns = begin_ns;
  shot.software_window = drawable.shape.resizable && source_.draws_in_software();
  shot.read = [this, &drawable](CapturedFrame& frame) { return source_.read(present_, drawable, frame); };
  return shot;
}

Shot ShotBuilder::of_present(const Drawable& drawable, uint64_t begin_ns) const {
  Shot shot = of_drawable(drawable, begin_ns);
  shot.damage = damage_text(present_);
  shot.may_be_late = true;
  return shot;
}

Shot ShotBuilder::of_buffer(const Drawable& drawable, GLenum buffer, const char* cause,
                            uint64_t begin_ns) const {
  Shot shot = of_drawable(drawable, begin_ns);
  shot.cause = cause;
  if (buffer == GL_FRONT || buffer == GL_FRONT_LEFT)
    shot.read = [this, &drawable, buffer](CapturedFrame& frame) {
      return source_.read_in_place(present_, drawable, buffer, frame);
    };
  return shot;
}

Shot ShotBuilder::of_image(const Attachment& image, const Result<ImageShape>& measured, FramebufferUse use,
                           SurfaceRole role, const char* cause, uint64_t begin_ns) const {
  Shot shot;
  shot.key = {source_.context(), image.image(), role};
  shot.cause = cause;
  shot.origin = image.text();
  shot.begin_ns = begin_ns;
  if (!measured) return shot;
  shot.shape = measured->shape;
  if (measured->samples > 0) {
    shot.origin += " resolved";
    shot.read = [this, &image, &measured](CapturedFrame& frame) {
      return read_resolved_image(image, measured->shape, frame);
    };
    return shot;
  }
  shot.read = [this, &image, &measured, use](CapturedFrame& frame) -> Result<void> {
    frame.way = ReadWay::kInContext;
    if (read_attachment_in_program_context(source_.gl(), image, use, measured->shape, frame)) return {};
    return unreadable("the program's context cannot be read");
  };
  return shot;
}

Result<void> ShotBuilder::read_resolved_image(const Attachment& image, const SurfaceShape& shape,
                                              CapturedFrame& frame) const {
  const uint64_t begin_ns = now_ns();
  uint64_t inside_ns = 0;
  Result<void> read;
  const auto work = [&] {
    const uint64_t bound_ns = now_ns();
    read = read_resolved(source_.gl(), image, shape, frame);
    inside_ns = now_ns() - bound_ns;
  };
  const Result<void> ran = source_.beside(present_, work);
  frame.bind_ns = now_ns() - begin_ns - inside_ns;
  return ran ? read : ran;
}

}  // namespace tilepress
