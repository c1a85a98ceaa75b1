// RAS memo: the bits of the RAS streams of a surface's blocks, counted anew only where pixels changed.
#pragma once

#include <cstdint>
#include <vector>

#include "ras/ras_stream.h"

namespace tilepress {

/// A block that is as it was in the frame before has as many bits as it had.
class RasMemo {
 public:
  /// `plain`, `ycocg`: which streams will be asked for; the same for all frames of a surface.
  void begin_frame(size_t blocks, bool has_before, bool plain, bool ycocg) {
    if (plain) plain_.resize(blocks);
    if (ycocg) ycocg_.resize(blocks);
    if (plain || ycocg) changed_.assign(blocks, has_before ? 0 : 1);
  }
  /// Where to note the blocks that change, one byte each in raster order, see PixelPlane; null if nobody
  /// asks.
  uint8_t* changed_blocks() { return changed_.empty() ? nullptr : changed_.data(); }
  /// Bits of block `number`, which begins at `top_left`. Precondition: each block that is not uniform is
  /// asked for in each frame.
  uint32_t bits(size_t number, const uint32_t* top_left, uint32_t stride, const FormatTraits& format,
                bool ycocg) {
    uint16_t& known = (ycocg ? ycocg_ : plain_)[number];
    if (changed_[number] != 0)
      known = static_cast<uint16_t>(ras_stream_bits(top_left, stride, format, ycocg));
    return known;
  }

 private:
  std::vector<uint8_t> changed_;
  std::vector<uint16_t> plain_, ycocg_;
};

}  // namespace tilepress
