// Row prefetch: a frame's rows are brought near in the order in which they lie, before blocks read them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tilepress/plane.h"
#include "tilepress/surface.h"

namespace tilepress {

/// Blocks read a few bytes of many rows, which no processor guesses, and a copy of rows has nothing to do
/// while it waits for another core's cache. So the rows of the next tiles are asked for, line after line,
/// while those before are worked on.
class RowPrefetch {
 public:
  static constexpr uint32_t kLineBytes = 64;  ///< of memory
  /// Rows of more bytes than this would push each other out of the cache.
  static constexpr uint64_t kMostBytes = 512 << 10;

  /// The next are rows `begin` to `end` of `frame`, which must stay as it is until the last step.
  void aim(const SurfaceView& frame, uint32_t begin, uint32_t end) {
    row_ = frame.row(begin);
    pitch_ = frame.pitch_bytes;
    row_bytes_ = frame.width * (traits(frame.format).pixel_bits / 8);
    at_ = 0;
    rows_ = end - begin;
  }
  /// Asks for the next `lines` lines, if there are so many left.
  void step(uint32_t lines) {
    while (lines > 0 && rows_ > 0) {
      const std::byte* const row = row_;
      uint32_t at = at_;  // in a register
      for (; lines > 0 && at < row_bytes_; --lines, at += kLineBytes) __builtin_prefetch(row + at, 0, 2);
      at_ = at;
      if (at < row_bytes_) return;
      at_ = 0;
      row_ += pitch_;
      --rows_;
    }
  }
  /// Asks for blocks `bx` to `bx_end` of row `by`, which step() asked for, once more: they are next.
  static void bring_nearer(const PixelPlane& plane, uint32_t bx, uint32_t bx_end, uint32_t by) {
    for (uint32_t y = by * kBlockSide; y < (by + 1) * kBlockSide; ++y)
      for (uint32_t x = bx * kBlockSide; x < bx_end * kBlockSide; x += kLineBytes / sizeof(uint32_t))
        __builtin_prefetch(plane.row(y) + x, 0, 3);
  }

 private:
  const std::byte* row_ = nullptr;
  ptrdiff_t pitch_ = 0;
  uint32_t row_bytes_ = 0, at_ = 0, rows_ = 0;  ///< where in a row the next line is; rows left
};

}  // namespace tilepress
