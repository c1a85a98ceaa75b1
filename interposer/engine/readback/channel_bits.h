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
std::optional<PixelFormat> format_of(const ChannelBits& bits);

}  // namespace tilepress
