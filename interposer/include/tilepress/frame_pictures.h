// Frame pictures: heat maps and pixels of chosen frames, in the run directory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/result.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

/// Writes the pictures that a run's options name:
///   heatmaps/<surface>-<frame>-<scheme>.pgm   one sample per block: its payload bits, 16 bits, most
///                                             significant byte first. The maximum is the size of a raw
///                                             block. The comment "# scheme <full name>" follows "P5".
///   frames/<surface>-<frame>.rgba             the pixels, by write_raw_frame()
/// Frame numbers have at least six digits, so that names sort.
class FramePictures {
 public:
  /// Pictures go below `run_path`. The first picture makes its folder.
  void open(const std::string& run_path, const RunOptions& options);
  /// Where the engine writes the bits of this frame's blocks; null if this frame has no heat map.
  BlockBits* bits_for(uint64_t frame);
  /// Writes the wanted pictures of `frame`, whose pixels `view` shows.
  Result<void> write(const FrameStatistics& frame, const SurfaceView& view);

 private:
  Result<void> write_heat_maps(const FrameStatistics& frame);
  std::string run_path_;
  std::vector<std::string> scheme_names_;
  uint64_t heatmaps_every_ = 0, dump_every_ = 0;
  BlockBits bits_;
};

/// Writes a frame's pixels, top row first, without gaps. A pixel with 8-bit channels is R,G,B,A; A = 255
/// where the format has no alpha. Other pixels are their native 2 or 4 bytes, little-endian.
Result<void> write_raw_frame(const std::string& path, const SurfaceView& view);

}  // namespace tilepress
