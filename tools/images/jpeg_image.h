// JPEG image: by libjpeg.
#pragma once

#include <string>

#include "images/image_library.h"

namespace tilepress {

/// The orientation that Exif may hold is not applied.
OpenedImage open_jpeg(const std::string& path);

}  // namespace tilepress
