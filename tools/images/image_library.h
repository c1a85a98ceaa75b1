// Image library: reads and writes image files. The library is a module that is loaded at its first use:
// OpenImageIO brings some 200 libraries along, which would slow every start of the command by a fifth of a
// second.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// One image of a file.
struct ImageHeader {
  uint32_t width = 0, height = 0;
  uint32_t channels = 0;  ///< 1 to 4: gray, gray and alpha, RGB, RGBA
  bool operator==(const ImageHeader&) const = default;
};

/// An open file of one or more images, or of a sequence. Error texts follow the name of the file. Not
/// thread-safe.
class ImageFile {
 public:
  virtual ~ImageFile() = default;
  /// One header per image. A sequence has one header for all its frames.
  const std::vector<ImageHeader>& images() const { return images_; }
  /// True for a movie or an animation: next() decodes its frames. Otherwise read() decodes its images.
  bool is_sequence() const { return sequence_; }
  /// One line about the parts of the file that are left out; empty if there are none.
  const std::string& left_out() const { return left_out_; }

  /// Decodes to 8 bits a channel, rows from the top, tight, alpha as stored. `out` has room for 4 channels.
  virtual Result<void> read(uint32_t image, std::byte* out) = 0;
  /// Decodes the next frame of a sequence to R,G,B,A. Returns false after the last frame.
  virtual Result<bool> next(std::byte*) { return false; }

 protected:
  const ImageHeader& header() const { return images_.front(); }
  std::vector<ImageHeader> images_;
  bool sequence_ = false;
  std::string left_out_;
};

using OpenedImage = Result<std::unique_ptr<ImageFile>>;

/// Opens a file with the reader T, which has a function open(arguments…) that returns Result<void>.
template <class T, class... Arguments>
OpenedImage open_with(Arguments&&... arguments) {
  auto file = std::make_unique<T>();
  if (const Result<void> opened = file->open(arguments...); !opened) return opened.error();
  return std::unique_ptr<ImageFile>(std::move(file));
}

/// Pixels for a PNG.
struct PngPixels {
  uint32_t width = 0, height = 0;
  uint32_t channels = 0;      ///< 3 or 4, unassociated alpha
  uint32_t channel_bits = 8;  ///< 8 or 16
  const void* samples = nullptr;
  uint32_t pixel_bytes = 0;  ///< from one pixel to the next; 0: tight
};

/// What the module exports. Thread-safe.
class ImageLibrary {
 public:
  virtual ~ImageLibrary() = default;
  /// Opens any image or movie except a still PNG.
  virtual OpenedImage open(const std::string& path) const = 0;
  /// Whether a file with these first bytes may be a movie. 64 KiB are enough to know.
  virtual bool may_be_movie(std::string_view start) const = 0;
  /// Writes quickly: 4 % larger files than with the default effort, in half the time.
  virtual Result<void> write_png(const std::string& path, const PngPixels& pixels) const = 0;
  /// Returns the bytes of a PNG file, as few as possible. Returns none on failure.
  virtual std::vector<uint8_t> encode_png(const PngPixels& pixels) const = 0;
};

/// Loads the module. Fails if the module is missing.
Result<const ImageLibrary*> image_library();

/// Opens an image or movie by its content. Loads the module for all files but still PNGs.
OpenedImage open_image(const std::string& path);

}  // namespace tilepress
