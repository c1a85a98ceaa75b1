// Pixel plane: a frame's pixel words, row 0 on top, tight, padded to whole blocks.
#pragma once

#include <cstdint>
#include <vector>

#include "tilepress/block.h"
#include "tilepress/surface.h"

namespace tilepress {

/// A frame in the form that schemes work on: pixel words with alpha 255 where the format has none, padded to
/// a multiple of 8 in both directions by the nearest pixel inside the surface. Frames of one size
/// re-use the memory.
class PixelPlane {
 public:
  /// Copies `view`, one pixel per word. Returns how many pixels changed. That number has no meaning unless
  /// the plane held a copy of a frame of the same size and format. Precondition: 1 ≤ width, height ≤
  /// kMaxSurfaceSide and a modelled format.
  uint64_t assign(const SurfaceView& view);
  /// The same in steps: reshape() takes the size and format, assign_rows() a range of rows. A range begins
  /// and ends at a multiple of 8 or at the bottom of the padded plane. If a pixel of a block changes, the
  /// block's byte of `changed_blocks` becomes other than 0 (raster order; null: not wanted).
  void reshape(const SurfaceView& view);
  uint64_t assign_rows(const SurfaceView& view, uint32_t begin, uint32_t end,
                       uint8_t* changed_blocks = nullptr);
  /// Refers to `view` without a copy, and returns true, if its rows are pixel words in whole blocks. Else
  /// changes nothing. `view` must outlive the use of the plane.
  bool refer_to(const SurfaceView& view);

  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  uint32_t padded_width() const { return padded_width_; }
  uint32_t stride() const { return stride_; }  ///< words from row to row, at least padded_width()
  uint32_t blocks_x() const { return padded_width_ / kBlockSide; }
  uint32_t blocks_y() const { return padded_height_ / kBlockSide; }
  uint64_t blocks() const { return uint64_t{blocks_x()} * blocks_y(); }
  PixelFormat format() const { return format_; }
  const uint32_t* row(uint32_t y) const {
    return (referred_ != nullptr ? referred_ : words_.data()) + size_t{y} * stride_;
  }

  /// Copies block (bx, by) to `out`.
  void load_block(uint32_t bx, uint32_t by, Block& out) const;
  bool has_shape_of(const SurfaceView& view) const {
    return width_ == view.width && height_ == view.height && format_ == view.format;
  }

 private:
  void take_shape(const SurfaceView& view);

  uint32_t width_ = 0, height_ = 0, padded_width_ = 0, padded_height_ = 0, stride_ = 0;
  PixelFormat format_ = PixelFormat::kRgba8;
  const uint32_t* referred_ = nullptr;  ///< the rows, if they are not in words_
  std::vector<uint32_t> words_;
};

}  // namespace tilepress
