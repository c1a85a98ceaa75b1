// Image library: reads and writes image files. Loaded when first asked for: OpenImageIO brings some 200
// libraries along, which would slow every start of the command by a fifth of a second.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tilepress {

/// One image of a file.
struct ImageHeader {
  uint32_t width = 0, height = 0, channels = 0;
  std::string refusal = {};  ///< why the pixels cannot be taken as they are stored; empty if they can
};

/// The refusal of samples of `type` ("uint16", "half", ...), of more than 8 bits.
inline std::string deep_refusal(const std::string& type) {
  return "has " + type + " channels; only 8 bits a channel are taken, nothing is narrowed";
}

/// An open file of one or more images. Not thread-safe.
class ImageFile {
 public:
  virtual ~ImageFile() = default;
  /// False: the file has no such image; with a reason if the file is damaged there. Images of a sequence have
  /// one header, that of image 0.
  virtual bool header(uint32_t image, ImageHeader& out, std::string& reason) = 0;
  /// Decodes to 8 bits a channel, rows from the top, tight, alpha as stored. `out` has room for 4 channels.
  /// False and a reason, maybe empty. Not for a sequence.
  virtual bool read(uint32_t image, uint32_t channels, std::byte* out, std::string& reason) = 0;

  /// True for a movie or an animation: its frames are decoded in order, each once, and counted by that.
  virtual bool is_sequence() const { return false; }
  /// Decodes the next frame of a sequence to R,G,B,A. False: the last one has been read, or a reason.
  virtual bool next(std::byte*, std::string&) { return false; }
  /// One line about what of the file is not taken; empty if all is.
  virtual std::string left_out() const { return {}; }
};

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
  /// Opens any image or movie but a still PNG. Null and a reason, maybe empty.
  virtual std::unique_ptr<ImageFile> open(const std::string& path, std::string& reason) const = 0;
  /// Whether a file that begins like this may be a movie; some 64 KiB tell.
  virtual bool may_be_movie(std::string_view start) const = 0;
  /// False and a reason.
  virtual bool write_png(const std::string& path, const PngPixels& pixels, std::string& reason) const = 0;
  /// The bytes of a PNG file, as small as can be; none on failure.
  virtual std::vector<uint8_t> encode_png(const PngPixels& pixels) const = 0;
};

/// The library; null and one line in `error` if it is not there.
const ImageLibrary* image_library(std::string& error);

}  // namespace tilepress
