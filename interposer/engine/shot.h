// Shot: a frame that could be taken, and how to read it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "interposer/engine/readback/attachment_shape.h"
#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/source/present_source.h"
#include "tilepress/result.h"

namespace tilepress {

struct Shot {
  WindowKey key{};
  SurfaceShape shape;
  const char* cause = "swap";  ///< as CapturedFrame::cause
  std::string origin;          ///< as CapturedFrame::origin
  std::string damage;          ///< as CapturedFrame::damage
  uint64_t begin_ns = 0;       ///< when its capture began
  bool may_be_late = false;    ///< the pixels may arrive after the call
  /// A window that Mesa draws on the processor. Such a window may be resized at any time. When another
  /// context becomes current on it, the driver takes new buffers and never shows what was drawn into the old
  /// ones. NVIDIA's driver keeps what was drawn then. But when such a window is read in the program's
  /// context, NVIDIA's driver loses the frame or ends the program.
  bool software_window = false;
  std::function<Result<void>(CapturedFrame& frame)> read;
};

/// Builds the shots of one call. A shot refers to the source, the present, and the drawable or image: all
/// must outlive it.
class ShotBuilder {
 public:
  ShotBuilder(PresentSource& source, const TilepressPresent& present) : source_(source), present_(present) {}

  Shot of_present(const Drawable& drawable, uint64_t begin_ns) const;
  /// A trigger that ends a frame in `buffer` (GL_BACK, GL_FRONT, …) of the default framebuffer.
  Shot of_buffer(const Drawable& drawable, GLenum buffer, const char* cause, uint64_t begin_ns) const;
  /// An image of the framebuffer object that is bound for `use`.
  Shot of_image(const Attachment& image, const Result<ImageShape>& measured, FramebufferUse use,
                SurfaceRole role, const char* cause, uint64_t begin_ns) const;

 private:
  Shot of_drawable(const Drawable& drawable, uint64_t begin_ns) const;
  Result<void> read_resolved_image(const Attachment& image, const SurfaceShape& shape,
                                   CapturedFrame& frame) const;
  PresentSource& source_;
  const TilepressPresent& present_;
};

}  // namespace tilepress
