// Pixel plane: swizzles a surface to pixel words and pads it to whole blocks.
#include "tilepress/plane.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace tilepress {
namespace {

uint32_t round_up_to_block(uint32_t pixels) {
  return (pixels + kBlockSide - 1) / kBlockSide * kBlockSide;
}

uint32_t swap_red_blue(uint32_t word) {
  return (word & 0xFF00FF00u) | (word >> 16 & 0xFFu) | (word & 0xFFu) << 16;
}

void copy_row(const std::byte* source, const SurfaceView& view, uint32_t* target) {
  if (view.format == PixelFormat::kRgb565) {
    for (uint32_t x = 0; x < view.width; ++x) {
      uint16_t word;
      std::memcpy(&word, source + size_t{x} * 2, 2);
      target[x] = word;
    }
    return;
  }
  std::memcpy(target, source, size_t{view.width} * 4);
  const bool eight_bit = view.format == PixelFormat::kRgba8 || view.format == PixelFormat::kRgbx8;
  if (eight_bit && view.order == ByteOrder::kBgra)
    for (uint32_t x = 0; x < view.width; ++x) target[x] = swap_red_blue(target[x]);
  if (view.format == PixelFormat::kRgbx8)
    for (uint32_t x = 0; x < view.width; ++x) target[x] |= 0xFF000000u;
}

}  // namespace

void PixelPlane::assign(const SurfaceView& view) {
  assert(view.width >= 1 && view.width <= kMaxSurfaceSide && view.height >= 1 &&
         view.height <= kMaxSurfaceSide && traits(view.format).modelled);
  width_ = view.width;
  height_ = view.height;
  format_ = view.format;
  stride_ = round_up_to_block(width_);
  padded_height_ = round_up_to_block(height_);
  words_.resize(size_t{stride_} * padded_height_);
  for (uint32_t y = 0; y < height_; ++y) {
    uint32_t* target = words_.data() + size_t{y} * stride_;
    copy_row(view.row(y), view, target);
    std::fill(target + width_, target + stride_, target[width_ - 1]);
  }
  for (uint32_t y = height_; y < padded_height_; ++y)
    std::copy_n(row(height_ - 1), stride_, words_.data() + size_t{y} * stride_);
}

void PixelPlane::load_block(uint32_t bx, uint32_t by, Block& out) const {
  const uint32_t* source = row(by * kBlockSide) + bx * kBlockSide;
  for (uint32_t y = 0; y < kBlockSide; ++y, source += stride_)
    std::memcpy(&out.pixels[y * kBlockSide], source, kBlockSide * sizeof(uint32_t));
}

}  // namespace tilepress
