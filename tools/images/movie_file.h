// Movie file: the frames of a movie or an animated PNG in the order of presentation, by libavformat.
#pragma once

#include <string>
#include <string_view>

#include "images/image_library.h"

namespace tilepress {

OpenedImage open_movie(const std::string& path);

/// Opens an animated PNG. Its last frame fails if the decoder returns fewer frames than the file holds.
OpenedImage open_apng(const std::string& path);

/// Whether a file that begins like this may be a movie.
bool is_movie_start(std::string_view start);

}  // namespace tilepress
