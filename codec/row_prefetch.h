// Row prefetch: a frame's rows are brought near in the order in which they lie, before blocks read them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tilepress/plane.h"

namespace tilepress {

/// Blocks read a few bytes of many rows, which no processor guesses. So the rows of the next tiles are asked
/// for, line after line, while those before are worked on.
class RowPrefetch {
 public:
  /// Of pixels, in a line of memory: 64 bytes.
  static constexpr uint32_t kLinePixels = 16;
  /// Rows of more bytes than this would push each other out of the cache.
  static constexpr uint64_t kMostBytes = 512 << 10;

  /// The next are rows `begin` to `end` of `plane`, which must stay as it is until the last step.
  void aim(const PixelPlane& plane, uint32_t begin, uint32_t end) {
    row_ = plane.row(begin);
    stride_ = plane.stride();
    width_ = plane.width();
    x_ = 0;
    rows_ = end - begin;
  }
  /// Asks for the next `lines` lines, if there are so many left.
  void step(uint32_t lines) {
    while (lines > 0 && rows_ > 0) {
      const uint32_t* const row = row_;
      uint32_t x = x_;  // in a register
      for (; lines > 0 && x < width_; --lines, x += kLinePixels) __builtin_prefetch(row + x, 0, 2);
      x_ = x;
      if (x < width_) return;
      x_ = 0;
      row_ += stride_;
      --rows_;
    }
  }
  /// Asks for blocks `bx` to `bx_end` of row `by`, which step() asked for, once more: they are next.
  static void bring_nearer(const PixelPlane& plane, uint32_t bx, uint32_t bx_end, uint32_t by) {
    for (uint32_t y = by * kBlockSide; y < (by + 1) * kBlockSide; ++y)
      for (uint32_t x = bx * kBlockSide; x < bx_end * kBlockSide; x += kLinePixels)
        __builtin_prefetch(plane.row(y) + x, 0, 3);
  }

 private:
  const uint32_t* row_ = nullptr;
  size_t stride_ = 0;
  uint32_t width_ = 0, x_ = 0, rows_ = 0;  ///< pixels in a row, and where the next line is; rows left
};

}  // namespace tilepress
