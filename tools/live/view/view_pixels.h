// View pixels: a live picture as colours for the screen, and what its blocks say.
#pragma once

#include <cstdint>
#include <vector>

#include "tilepress/live_picture.h"

namespace tilepress {

/// A picture as R,G,B,A bytes, rows from the top.
struct ScreenImage {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> bytes;
};

/// The frame, opaque as on a screen, each channel widened to 8 bits. Every `step`th pixel of every `step`th
/// row, step being the least at which no side is longer than `longest_side`.
ScreenImage frame_image(const LivePicture& picture, uint32_t longest_side);

/// A pixel per block: the heat colour of its bits. Opaque, or the clearer the fewer bits, so that the frame
/// below is seen. Empty if the scheme has no bits.
ScreenImage heat_image(const LivePicture& picture, size_t scheme, bool opaque);

struct BlockSummary {
  uint64_t blocks = 0, raw_blocks = 0;  ///< raw: as large as an uncompressed block
  double mean_bits = 0;
  uint32_t most_bits = 0;
};
BlockSummary summarize_blocks(const LivePicture& picture, size_t scheme);

}  // namespace tilepress
