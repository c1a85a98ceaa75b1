// Pixel source: where the pixels of a frame come from, row of tiles by row of tiles.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/row_prefetch.h"
#include "tilepress/plane.h"
#include "tilepress/surface.h"

namespace tilepress {

/// Reads the frame in place if its rows are pixel words and no one compares frames; else copies it.
/// Prefetches the rows of the next tiles either way.
class PixelSource {
 public:
  struct Needs {
    uint32_t tile_side = 32;     ///< pixels
    bool whole_frame = false;    ///< every row is there when the frame begins
    bool compares = false;       ///< changed() is wanted
    bool notes_changes = false;  ///< changed_blocks() is wanted
  };
  void open(const Needs& needs) { needs_ = needs; }

  /// `frame` must stay as it is until end_frame().
  void begin_frame(const SurfaceView& frame);
  /// Makes rows `begin` to `end` of blocks, one row of tiles, readable. Call it for all rows in order.
  void take_rows(uint32_t begin, uint32_t end);
  /// Prefetches what comes next while blocks `bx` to `bx_end` of row `by` are visited.
  void prefetch_beside(uint32_t bx, uint32_t bx_end, uint32_t by) {
    constexpr uint32_t kBlockLines = kBlockPixels * sizeof(uint32_t) / RowPrefetch::kLineBytes;
    if (!prefetches_) return;
    prefetch_.step((bx_end - bx) * kBlockLines);
    if (in_place_)
      RowPrefetch::bring_nearer(plane_, bx_end, std::min(2 * bx_end - bx, plane_.blocks_x()), by);
  }
  void end_frame() { has_before_ = true; }

  const PixelPlane& plane() const { return plane_; }
  const uint32_t* block(uint32_t bx, uint32_t by) const {
    return plane_.row(by * kBlockSide) + bx * kBlockSide;
  }
  /// Pixels of `blocks` blocks side by side that lie inside the surface.
  uint32_t pixels_inside(uint32_t bx, uint32_t blocks, uint32_t by) const {
    return std::min(blocks * kBlockSide, plane_.width() - bx * kBlockSide) *
           std::min(kBlockSide, plane_.height() - by * kBlockSide);
  }
  /// Pixels that changed since the frame before; none in the first frame.
  std::optional<uint64_t> changed() const {
    return has_before_ ? std::optional(changed_pixels_) : std::nullopt;
  }
  /// See FrameContext.
  const uint8_t* changed_blocks() const { return needs_.notes_changes ? changed_blocks_.data() : nullptr; }
  /// False before the first frame.
  bool has_before() const { return has_before_; }

 private:
  void copy_rows(uint32_t begin, uint32_t end);
  void aim_prefetch(uint32_t begin);

  Needs needs_;
  SurfaceView frame_;
  PixelPlane plane_;
  bool in_place_ = false;  ///< plane_ refers to the frame
  bool prefetches_ = false;
  bool has_before_ = false;  ///< plane_ held a frame before this one
  RowPrefetch prefetch_;
  uint64_t changed_pixels_ = 0;
  std::vector<uint8_t> changed_blocks_;
};

}  // namespace tilepress
