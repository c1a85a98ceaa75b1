// WebP image: a still or an animation, by libwebp.
#pragma once

#include <memory>
#include <string>

#include "images/image_library.h"

namespace tilepress {

/// Null and a reason if the file is cut off or damaged. Frames are composed on a transparent canvas, as
/// browsers do.
std::unique_ptr<ImageFile> open_webp(const std::string& path, std::string& reason);

}  // namespace tilepress
