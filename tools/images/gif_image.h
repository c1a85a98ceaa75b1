// GIF image: a still or an animation, by giflib.
#pragma once

#include <string>

#include "images/image_library.h"

namespace tilepress {

/// Frames are composed as browsers do: on a transparent canvas, whatever background colour the file names.
OpenedImage open_gif(const std::string& path);

}  // namespace tilepress
