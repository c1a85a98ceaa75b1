// GIF image: a still or an animation, by giflib.
#pragma once

#include <memory>
#include <string>

#include "images/image_library.h"

namespace tilepress {

/// Null and a reason if the file is cut off or damaged. Frames are composed as browsers do: on a transparent
/// canvas, whatever background colour the file names.
std::unique_ptr<ImageFile> open_gif(const std::string& path, std::string& reason);

}  // namespace tilepress
