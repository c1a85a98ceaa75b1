// Row prefetch: prefetches rows of a frame in memory order before blocks read them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tilepress/plane.h"
#include "tilepress/surface.h"

namespace tilepress {

/// A block reads a few bytes of eight rows, which no hardware prefetcher predicts. So the engine prefetches
/// the rows of the next tiles, line after line, while it works on the tiles before.
class RowPrefetch {
 public:
  static constexpr uint32_t kLineBytes = 64;  ///< of memory
  /// Rows of more bytes would evict each other from the cache.
  static constexpr uint64_t kMostBytes = 512 << 10;

  /// Aims at rows `begin` to `end` of `frame`, which must stay as it is until the last step.
  void aim(const SurfaceView& frame, uint32_t begin, uint32_t end) {
    row_ = frame.row(begin);
    pitch_ = frame.pitch_bytes;
    row_bytes_ = frame.width * (traits(frame.format).pixel_bits / 8);
    at_ = 0;
    rows_ = end - begin;
  }
  /// Prefetches the next `lines` lines, or the lines left.
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
  /// Prefetches blocks `bx` to `bx_end` of row `by` into the nearest cache; they are the next to visit.
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
