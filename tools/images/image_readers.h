// Image readers: the readers by format, each in a file of its own.
#pragma once

#include <string>
#include <string_view>

#include "images/image_library.h"

namespace tilepress {

/// `kind`: "bmp", "tga", "dds", "psd", "pnm", "sgi" or "qoi".
OpenedImage open_av_still(const std::string& path, std::string_view kind);

/// A still or an animation. Frames are composed as browsers do: on a transparent canvas, whatever background
/// colour the file names.
OpenedImage open_gif(const std::string& path);

/// The orientation that Exif may hold is not applied.
OpenedImage open_jpeg(const std::string& path);

/// A still or an animation. Frames of an animation are composed on a transparent canvas, as browsers do.
OpenedImage open_webp(const std::string& path);

/// The frames of a movie in the order of presentation.
OpenedImage open_movie(const std::string& path);

/// Opens an animated PNG. Its last frame fails if the decoder returns fewer frames than the file holds.
OpenedImage open_apng(const std::string& path);

/// Whether a file that begins like this may be a movie.
bool is_movie_start(std::string_view start);

/// Opens a PNG without the image library, whose start takes a fifth of a second. Samples are taken as stored:
/// no gamma, no profile. A palette, a transparent colour and gray of fewer than 8 bits become 8-bit channels.
/// Returns null for an animation.
OpenedImage open_png(const std::string& path);

}  // namespace tilepress
