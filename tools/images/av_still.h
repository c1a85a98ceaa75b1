// AV still: images that libavcodec decodes with the bits that the file holds.
#pragma once

#include <string>
#include <string_view>

#include "images/image_library.h"

namespace tilepress {

/// `kind`: "bmp", "tga", "dds", "psd", "pnm", "sgi" or "qoi".
OpenedImage open_av_still(const std::string& path, std::string_view kind);

}  // namespace tilepress
