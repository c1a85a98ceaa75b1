// Pixel plane: swizzles a surface to pixel words and pads it to whole blocks.
#include "tilepress/plane.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "pixels/pixel_kernels.h"

namespace tilepress {
namespace {

constexpr ptrdiff_t kMaxStride = 1 << 20;  ///< keeps offsets in a row of blocks within 32 bits

uint32_t round_up_to_block(uint32_t pixels) {
  return (pixels + kBlockSide - 1) / kBlockSide * kBlockSide;
}

/// Returns how many words of `target` changed; see PixelKernels::replace_row.
uint32_t copy_row(const std::byte* source, const SurfaceView& view, uint32_t* target,
                  uint8_t* changed_blocks) {
  if (view.format == PixelFormat::kRgb565) {
    uint32_t changed = 0;
    for (uint32_t x = 0; x < view.width; ++x) {
      uint16_t word;
      std::memcpy(&word, source + size_t{x} * 2, 2);
      if (target[x] == word) continue;
      target[x] = word;
      ++changed;
      if (changed_blocks != nullptr) changed_blocks[x / kBlockSide] = 1;
    }
    return changed;
  }
  const bool eight_bit = view.format == PixelFormat::kRgba8 || view.format == PixelFormat::kRgbx8;
  return pixel_kernels().replace_row(source, view.width, eight_bit && view.order == ByteOrder::kBgra,
                                     view.format == PixelFormat::kRgbx8 ? 0xFF000000u : 0u, target,
                                     changed_blocks);
}

}  // namespace

void PixelPlane::take_shape(const SurfaceView& view) {
  assert(view.width >= 1 && view.width <= kMaxSurfaceSide && view.height >= 1 &&
         view.height <= kMaxSurfaceSide && traits(view.format).modelled);
  width_ = view.width;
  height_ = view.height;
  format_ = view.format;
  padded_width_ = round_up_to_block(width_);
  padded_height_ = round_up_to_block(height_);
}

void PixelPlane::reshape(const SurfaceView& view) {
  take_shape(view);
  stride_ = padded_width_;
  referred_ = nullptr;
  words_.resize(size_t{stride_} * padded_height_);
}

bool PixelPlane::refer_to(const SurfaceView& view) {
  const bool words = view.format != PixelFormat::kRgb565 && view.format != PixelFormat::kRgbx8 &&
                     (view.format != PixelFormat::kRgba8 || view.order == ByteOrder::kRgba);
  const bool aligned = reinterpret_cast<uintptr_t>(view.top_row) % alignof(uint32_t) == 0 &&
                       view.pitch_bytes > 0 && view.pitch_bytes % ptrdiff_t{sizeof(uint32_t)} == 0;
  const ptrdiff_t stride = view.pitch_bytes / ptrdiff_t{sizeof(uint32_t)};
  if (!words || !aligned || stride > kMaxStride || view.width % kBlockSide != 0 ||
      view.height % kBlockSide != 0)
    return false;
  take_shape(view);
  stride_ = static_cast<uint32_t>(stride);
  referred_ = reinterpret_cast<const uint32_t*>(view.top_row);
  return true;
}

uint64_t PixelPlane::assign_rows(const SurfaceView& view, uint32_t begin, uint32_t end,
                                 uint8_t* changed_blocks) {
  uint64_t changed = 0;
  for (uint32_t y = begin; y < std::min(end, height_); ++y) {
    uint32_t* target = words_.data() + size_t{y} * stride_;
    uint8_t* blocks =
        changed_blocks == nullptr ? nullptr : changed_blocks + size_t{y / kBlockSide} * blocks_x();
    changed += copy_row(view.row(y), view, target, blocks);
    std::fill(target + width_, target + padded_width_, target[width_ - 1]);
  }
  for (uint32_t y = height_; y < end; ++y)
    std::copy_n(row(height_ - 1), stride_, words_.data() + size_t{y} * stride_);
  return changed;
}

uint64_t PixelPlane::assign(const SurfaceView& view) {
  reshape(view);
  return assign_rows(view, 0, padded_height_);
}

void PixelPlane::load_block(uint32_t bx, uint32_t by, Block& out) const {
  const uint32_t* source = row(by * kBlockSide) + bx * kBlockSide;
  for (uint32_t y = 0; y < kBlockSide; ++y, source += stride_)
    std::memcpy(&out.pixels[y * kBlockSide], source, kBlockSide * sizeof(uint32_t));
}

}  // namespace tilepress
