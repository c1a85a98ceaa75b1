// Pixel plane: a frame's pixel words, row 0 on top, tight, padded to whole blocks.
#pragma once

#include <cstdint>
#include <vector>

#include "tilepress/block.h"
#include "tilepress/surface.h"

namespace tilepress {

/// The canonical form of a frame on which everything else works: swizzled to pixel words, alpha forced to 255
/// where the format has none, and padded to a multiple of 8 in both directions by repeating the nearest pixel
/// inside the surface (spec §2). A copy, re-used from frame to frame: no allocation while the size stays.
class PixelPlane {
 public:
  /// Takes a copy of `view`. 16-bit pixels are stored one per word. Returns how many pixels differ from those
  /// it held before; of no meaning if that was a frame of another size or format, one referred to, or none.
  /// Precondition: 1 ≤ width, height ≤ kMaxSurfaceSide and a modelled format.
  uint64_t assign(const SurfaceView& view);
  /// The same in steps: takes on the shape of `view`; then its rows, in ranges that begin and end at a
  /// multiple of 8 or at the bottom of the padded plane. Where a pixel of a block changes, its byte of
  /// `changed_blocks` (raster order; null: not wanted) becomes other than 0.
  void reshape(const SurfaceView& view);
  uint64_t assign_rows(const SurfaceView& view, uint32_t begin, uint32_t end,
                       uint8_t* changed_blocks = nullptr);
  /// Stands for `view`, which must outlive that, without a copy, if its rows are pixel words and whole blocks
  /// as they lie. False, and nothing happened, if not.
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

  /// Copies block (bx, by) out.
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
