// Resolve readback: reads multisampled images and surfaces as their samples resolve.
#pragma once

#include "interposer/engine/readback/bound_framebuffer.h"
#include "interposer/engine/readback/captured_frame.h"
#include "interposer/engine/surface_registry.h"
#include "tilepress/result.h"

namespace tilepress {

/// In a private context that shares the program's objects. Resolves the image into a single-sampled one of
/// the same format and reads that into `frame`. Leaves no object behind.
Result<void> read_resolved(const GlFunctions& gl, const Attachment& attachment, const SurfaceShape& shape,
                           CapturedFrame& frame);

/// In a private context. While an object of this class lives, reads take the back buffer of the surface that
/// is current. A multisampled surface is resolved first: Mesa's glReadPixels returns one sample of each
/// pixel, while the window shows their mean.
class BackBuffer {
 public:
  BackBuffer(const GlFunctions& gl, const SurfaceShape& shape);
  ~BackBuffer();
  BackBuffer(const BackBuffer&) = delete;
  BackBuffer& operator=(const BackBuffer&) = delete;
  /// False if the resolve failed: there is nothing to read then.
  bool whole() const { return whole_; }

 private:
  const GlFunctions& gl_;
  GLuint framebuffer_ = 0, storage_ = 0;
  bool whole_ = true;
};

}  // namespace tilepress
