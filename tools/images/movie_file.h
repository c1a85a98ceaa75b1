// Movie file: the frames of a movie or an animated PNG in the order of presentation, by libavformat.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "images/image_library.h"

namespace tilepress {

/// Null and a reason, or no reason if the file is no movie.
std::unique_ptr<ImageFile> open_movie(const std::string& path, std::string& reason);

/// The same for an animated PNG; one that gives fewer frames than it holds is refused.
std::unique_ptr<ImageFile> open_apng(const std::string& path, std::string& reason);

/// Whether a file that begins like this may be a movie.
bool is_movie_start(std::string_view start);

}  // namespace tilepress
