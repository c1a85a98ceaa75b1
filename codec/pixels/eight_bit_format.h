// Eight-bit formats: for schemes that model RGBA8 and RGBX8 only.
#pragma once

#include "tilepress/pixel_format.h"

namespace tilepress {

/// True for RGBA8 and RGBX8.
constexpr bool has_eight_bit_channels(const FormatTraits& format) {
  return format.channel_bits == traits(PixelFormat::kRgba8).channel_bits;
}

}  // namespace tilepress
