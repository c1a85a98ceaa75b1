// Bound coders: what general compressors reach on a frame. A reader sees how far from possible a scheme is.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tilepress/plane.h"
#include "tilepress/result.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// General compressors, on each block alone or on the whole frame: lz4_block, zstd_block, lz4_frame,
/// zstd_frame, webp_frame.
const std::vector<std::string>& bound_names();

/// The coders and their memory. Not thread-safe.
///   lz4   LZ4_compress_default: the default level, no frame around the data
///   zstd  level 3, the default. A block's size leaves out the frame header, equal for all blocks
///   webp  lossless, level 0 (the fastest), colours of transparent pixels kept
/// A block is its 64 pixels in traversal order, 4 bytes each. A frame is the rows of pixels inside the surface.
class BoundCoders {
 public:
  BoundCoders();
  ~BoundCoders();
  BoundCoders(const BoundCoders&) = delete;
  BoundCoders& operator=(const BoundCoders&) = delete;

  /// Fills `out` in the order of bound_names(). Blocks and frames are stored raw where compression saves
  /// nothing, and fill whole bursts. No status bits are counted. A frame that WebP cannot hold has `skipped`
  /// set there. Precondition: `frame` has 8-bit channels. Error: kSystem, libwebp failed.
  Result<void> measure(const PixelPlane& frame, uint32_t burst_bits, std::vector<SchemeStatistics>& out);

 private:
  struct Contexts;
  size_t lz4_bytes(std::span<const uint32_t> pixels);
  size_t zstd_bytes(std::span<const uint32_t> pixels);
  void measure_blocks(const PixelPlane& frame, SchemeStatistics& lz4, SchemeStatistics& zstd);
  std::unique_ptr<Contexts> contexts_;
};

/// True for RGBA8 and RGBX8: the formats that the bounds take.
bool has_bounds(PixelFormat format);

}  // namespace tilepress
