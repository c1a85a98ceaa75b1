// PNG image: libpng without the image library, whose start takes a fifth of a second.
#pragma once

#include <memory>
#include <string>

#include "images/image_library.h"

namespace tilepress {

/// Opens a PNG. Samples are taken as they are stored: no gamma, no profile. A palette, a transparent colour
/// and gray of fewer than 8 bits become 8-bit channels. Null and a reason if the header is damaged. Null and
/// no reason if the PNG is an animation.
std::unique_ptr<ImageFile> open_png(const std::string& path, std::string& reason);

}  // namespace tilepress
