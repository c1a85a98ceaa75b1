// Plain PNG: the commonest images without the image library, whose start takes a fifth of a second.
#pragma once

#include <memory>
#include <string>

#include "images/image_library.h"

namespace tilepress {

/// Opens a PNG of 8-bit RGB or RGBA that is neither interlaced nor has a transparent colour: its samples are
/// taken as they are stored. Null for any other file, or if there is none. What turns out to be damaged is
/// left to the image library, and to what it says of it.
std::unique_ptr<ImageFile> open_plain_png(const std::string& path);

}  // namespace tilepress
