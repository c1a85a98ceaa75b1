// Transfer: the arguments of glReadPixels that return a format's pixels without a conversion.
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <cstdint>

#include "tilepress/pixel_format.h"
#include "tilepress/surface.h"

namespace tilepress {

struct Transfer {
  GLenum format, type;
  uint32_t pixel_bytes;
  ByteOrder order;
};

/// `preferred_format` and `preferred_type` are GL_IMPLEMENTATION_COLOR_READ_FORMAT and _TYPE of the bound
/// buffer, or 0. Pixels with 8 bits per channel come as RGBA unless the implementation prefers BGRA.
inline Transfer transfer_of(PixelFormat format, GLint preferred_format, GLint preferred_type) {
  switch (format) {
    case PixelFormat::kRgb565:
      return {GL_RGB, GL_UNSIGNED_SHORT_5_6_5, 2, ByteOrder::kNative};
    case PixelFormat::kRgb10a2:
      return {GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, 4, ByteOrder::kNative};
    case PixelFormat::kRgba16f:
      return {GL_RGBA, GL_HALF_FLOAT, 8, ByteOrder::kNative};
    default:
      break;
  }
  const bool bytes = preferred_type == GL_UNSIGNED_BYTE || preferred_type == GL_UNSIGNED_INT_8_8_8_8_REV;
  if (preferred_format == GL_BGRA && bytes)
    return {GL_BGRA, static_cast<GLenum>(preferred_type), 4, ByteOrder::kBgra};
  return {GL_RGBA, GL_UNSIGNED_BYTE, 4, ByteOrder::kRgba};
}

}  // namespace tilepress
