// PNG image: libpng without the image library, whose start takes a fifth of a second.
#pragma once

#include <string>

#include "images/image_library.h"

namespace tilepress {

/// Opens a PNG. Samples are taken as stored: no gamma, no profile. A palette, a transparent colour and gray
/// of fewer than 8 bits become 8-bit channels. Returns null for an animation.
OpenedImage open_png(const std::string& path);

}  // namespace tilepress
