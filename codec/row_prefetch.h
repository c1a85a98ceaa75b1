// Row prefetch: a frame's rows are brought near in the order in which they lie, before blocks read them.
#pragma once

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

  /// The next are rows `begin` to `end` of `plane`, which must outlive the steps.
  void aim(const PixelPlane& plane, uint32_t begin, uint32_t end) {
    plane_ = &plane;
    x_ = 0;
    y_ = begin;
    end_ = end;
  }
  /// Asks for the next `lines` lines, if there are so many left.
  void step(uint32_t lines) {
    for (; lines > 0 && y_ < end_; --lines) {
      __builtin_prefetch(plane_->row(y_) + x_, 0, 2);
      x_ += kLinePixels;
      if (x_ < plane_->width()) continue;
      x_ = 0;
      ++y_;
    }
  }

 private:
  const PixelPlane* plane_ = nullptr;
  uint32_t x_ = 0, y_ = 0, end_ = 0;  ///< the next line; and the row where to stop
};

}  // namespace tilepress
