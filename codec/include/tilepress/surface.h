// Surface view: the pixels of one frame in the caller's memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tilepress/pixel_format.h"

namespace tilepress {

/// Order of the four bytes of an 8-bit-per-channel pixel in memory. Formats of other depths use kNative.
enum class ByteOrder : uint8_t { kRgba, kBgra, kNative = kRgba };

/// A frame in memory. `top_row` is the first byte of the TOP row of the picture. `pitch_bytes` leads from a
/// row to the row below: negative for buffers stored bottom-up, as glReadPixels fills them. The view does not
/// own the memory, which must stay valid and unchanged during a call.
struct SurfaceView {
  const std::byte* top_row = nullptr;
  ptrdiff_t pitch_bytes = 0;
  uint32_t width = 0;   ///< pixels, 1..65535
  uint32_t height = 0;  ///< pixels, 1..65535
  PixelFormat format = PixelFormat::kRgba8;
  ByteOrder order = ByteOrder::kRgba;

  const std::byte* row(uint32_t y) const { return top_row + static_cast<ptrdiff_t>(y) * pitch_bytes; }
};

constexpr uint32_t kMaxSurfaceSide = 65535;

}  // namespace tilepress
