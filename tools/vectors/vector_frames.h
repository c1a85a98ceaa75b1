// Vector frames: runs frames through the encoder and the plain FVC, and writes the files of each wanted
// frame.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "frames/image_frames.h"
#include "tilepress/compressed_surface.h"
#include "tilepress/fvc_follower.h"
#include "tilepress/plane.h"
#include "tilepress/surface_engine.h"
#include "vectors/frame_parameters.h"

namespace tilepress {

/// The blocks whose lines are written: `count` blocks from number `first` on, in the order of commitment.
struct BlockWindow {
  uint64_t first = 0;
  uint64_t count = UINT64_MAX;
  bool contains(uint64_t number) const { return number >= first && number - first < count; }
};

/// One surface and one scheme. Error texts name the file.
class VectorFrames {
 public:
  VectorFrames(const SchemeSpec& scheme, const ModelOptions& model, PixelFormat format, BlockWindow window);

  /// Models the next frame, `number` of the input. Fails if a block does not come back from its bits.
  Result<void> model(const SurfaceView& view, uint64_t number);
  /// Takes the frame at hand through the FVC, and writes its files into `folder`, which exists. An empty
  /// `folder` writes nothing. Call it once after model(). Precondition: the window begins inside the frame.
  Result<VectorFrame> write(const std::string& folder);

  /// The frame that model() took last, as memory holds it.
  const CompressedSurface& surface() const { return surface_; }

 private:
  class BlockFiles;
  FvcPair pass_blocks(BlockFiles* files);
  Result<void> write_dictionaries(const std::string& folder, const VectorFrame& frame,
                                  const FvcState& before_frame, const FvcPair& states) const;
  VectorFrame describe() const;

  const ModelOptions model_;
  const BlockWindow window_;
  SurfaceEngine engine_;
  std::optional<FvcFollower> follower_;
  PixelPlane plane_;
  FrameStatistics statistics_;
  CompressedSurface surface_;
  uint64_t number_ = 0, ordinal_ = 0;
};

}  // namespace tilepress
