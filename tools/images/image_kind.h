// Image kind: what a file holds, by its first bytes and never by its name.
#pragma once

#include <cstddef>
#include <string_view>

namespace tilepress {

/// Which reader takes a file.
enum class ImageReader {
  kMovie,  ///< no image signature: a movie, or nothing that is read
  kPng,
  kJpeg,
  kGif,
  kWebp,
  kAvStill,   ///< a decoder of libavcodec
  kOiio,      ///< OpenImageIO
  kRefused,   ///< an image of a kind that no reader takes
};

struct ImageKind {
  std::string_view name;  ///< "png", ...: for kOiio the name of OpenImageIO's plugin; empty for kMovie
  ImageReader reader = ImageReader::kMovie;
};

/// As many first bytes of a file as image_kind() looks at.
constexpr size_t kImageKindBytes = 64;

/// `start`: the first bytes of a file, fewer than kImageKindBytes only if the file is shorter.
ImageKind image_kind(std::string_view start);

/// The same for a file; kMovie if the file cannot be read.
ImageKind image_kind_of_file(const char* path);

}  // namespace tilepress
