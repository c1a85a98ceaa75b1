// Surface store: the encoder's side of a compressed surface; puts blocks into their slots.
#pragma once

#include <array>

#include "tilepress/compressed_surface.h"
#include "tilepress/scheme.h"

namespace tilepress {

/// Writes one frame into a surface. Blocks may come in any order, each once.
class SurfaceStore {
 public:
  /// After encoder.begin_frame(). `out` is not owned; its buffers are re-used.
  void begin_frame(const SchemeSpec& spec, const ModelOptions& options, const FrameContext& frame,
                   const BlockEncoder& encoder, CompressedSurface& out);
  void put(const BlockEncoder& encoder, const BlockContext& block);

 private:
  CompressedSurface* surface_ = nullptr;
};

}  // namespace tilepress
