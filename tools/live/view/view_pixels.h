// View pixels: converts a live picture to colours for the screen, and sums up its blocks.
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

/// Returns the frame, opaque, each channel widened to 8 bits. If a side is longer than `longest_side`, the
/// image has every n-th pixel of every n-th row, with the smallest n that makes both sides fit.
ScreenImage frame_image(const LivePicture& picture, uint32_t longest_side);

/// Returns a pixel per block, the heat colour of its bits: opaque, or more transparent for fewer bits, so
/// that the frame below shows. Empty if the scheme has no bits.
ScreenImage heat_image(const LivePicture& picture, size_t scheme, bool opaque);

struct BlockSummary {
  uint64_t blocks = 0, raw_blocks = 0;  ///< raw blocks are as large as an uncompressed block
  double mean_bits = 0;
  uint32_t most_bits = 0;
};
BlockSummary summarize_blocks(const LivePicture& picture, size_t scheme);

}  // namespace tilepress
