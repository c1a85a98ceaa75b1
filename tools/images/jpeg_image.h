// JPEG image: by libjpeg.
#pragma once

#include <memory>
#include <string>

#include "images/image_library.h"

namespace tilepress {

/// Null and a reason if the header is cut off or damaged. The orientation that Exif may hold is not applied.
std::unique_ptr<ImageFile> open_jpeg(const std::string& path, std::string& reason);

}  // namespace tilepress
