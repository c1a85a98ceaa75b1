// Resolve readback: what is multisampled, read as what its samples resolve to.
#pragma once

#include <string>

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/surface_registry.h"

namespace tilepress {

/// In a private context that shares the program's objects: resolves the image into a single-sampled one of
/// the same format and reads that into `frame`. What it makes for that is gone when it returns. False, with
/// the reason, if it cannot.
bool read_resolved(const GlFunctions& gl, const Attachment& attachment, const SurfaceShape& shape,
                   CapturedFrame& frame, std::string& reason);

/// In a private context, on what it is current to: the buffer to read while this lives. Mesa's glReadPixels
/// takes one sample of each pixel of a multisampled surface, while what it shows is the mean: such a surface
/// is resolved first.
class BackBuffer {
 public:
  BackBuffer(const GlFunctions& gl, const SurfaceShape& shape);
  ~BackBuffer();
  BackBuffer(const BackBuffer&) = delete;
  BackBuffer& operator=(const BackBuffer&) = delete;
  /// 0, or the GL error of the resolve: there is nothing to read then.
  GLenum error() const { return error_; }

 private:
  const GlFunctions& gl_;
  GLuint framebuffer_ = 0, storage_ = 0;
  GLenum error_ = 0;
};

}  // namespace tilepress
