// Frame pictures: heat maps and pixels of chosen frames, kept in the run directory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/result.h"
#include "tilepress/run_options.h"
#include "tilepress/statistics.h"
#include "tilepress/surface_engine.h"

namespace tilepress {

/// Writes the pictures that a run's options ask for:
///   heatmaps/<surface>-<frame>-<scheme>.pgm  a sample per block, its payload bits, 16 bits each, most
///   significant
///       byte first; the largest value is that of a raw block; a comment "# scheme <its full name>" follows
///       the "P5"
///   frames/<surface>-<frame>.rgba            pixels as write_raw_frame() gives them
/// Frame numbers have six digits or more, so that names sort.
class FramePictures {
 public:
  /// Pictures go below `run_path`. Folders are made with the first picture.
  void open(const std::string& run_path, const RunOptions& options);
  /// Where the engine is to note the blocks' bits of this frame, or null if they are not wanted.
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

/// Writes a frame's pixels top row first, rows tight, as their canonical bytes (R,G,B,A for 8-bit channels,
/// with A = 255 where the format has none; the native 2 or 4 bytes, little-endian, otherwise).
Result<void> write_raw_frame(const std::string& path, const SurfaceView& view);

}  // namespace tilepress
