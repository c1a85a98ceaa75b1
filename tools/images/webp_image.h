// WebP image: a still or an animation, by libwebp.
#pragma once

#include <string>

#include "images/image_library.h"

namespace tilepress {

/// Frames of an animation are composed on a transparent canvas, as browsers do.
OpenedImage open_webp(const std::string& path);

}  // namespace tilepress
