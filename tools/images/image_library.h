// Image library: reads and writes image files. Loaded when first asked for: OpenImageIO brings some 200
// libraries along, which would slow every start of the command by a fifth of a second.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tilepress {

/// One image of a file.
struct ImageHeader {
  uint32_t width = 0, height = 0, channels = 0;
  std::string sample_type;  ///< "uint8", "half", ...
  bool volume = false;
};

/// An open file of one or more images. Not thread-safe.
class ImageFile {
 public:
  virtual ~ImageFile() = default;
  /// "png", "jpeg", ...
  virtual std::string kind() const = 0;
  /// False: the file has no such image.
  virtual bool header(uint32_t image, ImageHeader& out) = 0;
  /// Decodes to 8 bits a channel, rows from the top, tight, alpha as stored. False and a reason, maybe empty.
  virtual bool read(uint32_t image, uint32_t channels, std::byte* out, std::string& reason) = 0;
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
  /// Null and a reason, maybe empty.
  virtual std::unique_ptr<ImageFile> open(const std::string& path, std::string& reason) const = 0;
  /// False and a reason.
  virtual bool write_png(const std::string& path, const PngPixels& pixels, std::string& reason) const = 0;
  /// The bytes of a PNG file, as small as can be; none on failure.
  virtual std::vector<uint8_t> encode_png(const PngPixels& pixels) const = 0;
};

/// The library; null and one line in `error` if it is not there.
const ImageLibrary* image_library(std::string& error);

}  // namespace tilepress
