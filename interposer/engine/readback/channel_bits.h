// Channel bits: the pixel format of a config, visual or attachment.
#pragma once

#include <optional>

#include "tilepress/pixel_format.h"

namespace tilepress {

/// Bits of each colour channel of a config or visual.
struct ChannelBits {
  int red = 0, green = 0, blue = 0, alpha = 0;
  bool floating = false;
  bool integer = false;  ///< not normalized, or signed
};

/// Returns the pixel format with exactly these channels, if there is one.
inline std::optional<PixelFormat> format_of(const ChannelBits& bits) {
  const auto is = [&](int red, int green, int blue, int alpha) {
    return bits.red == red && bits.green == green && bits.blue == blue && bits.alpha == alpha;
  };
  if (bits.integer) return std::nullopt;
  if (bits.floating) return is(16, 16, 16, 16) ? std::optional(PixelFormat::kRgba16f) : std::nullopt;
  if (is(8, 8, 8, 8)) return PixelFormat::kRgba8;
  if (is(8, 8, 8, 0)) return PixelFormat::kRgbx8;
  if (is(5, 6, 5, 0)) return PixelFormat::kRgb565;
  if (is(10, 10, 10, 2) || is(10, 10, 10, 0)) return PixelFormat::kRgb10a2;  // without alpha GL reads A as 1
  return std::nullopt;
}

}  // namespace tilepress
