// Image writer: words to samples.
#include "frames/image_writer.h"

#include <cstring>
#include <vector>

#include "images/image_library.h"
#include "streams/output_file.h"

namespace tilepress {

/// Widens a channel from `from` to `to` bits by repeating its bits from the top: 0 stays 0, full stays full.
static uint32_t widen(uint32_t value, uint32_t from, uint32_t to) {
  uint32_t wide = 0;
  for (int32_t shift = static_cast<int32_t>(to - from); shift > -static_cast<int32_t>(from);
       shift -= static_cast<int32_t>(from))
    wide |= shift >= 0 ? value << shift : value >> -shift;
  return wide;
}

std::string native_bytes(std::span<const uint32_t> words, PixelFormat format) {
  const size_t pixel_bytes = traits(format).pixel_bits / 8;
  std::string bytes(words.size() * pixel_bytes, '\0');
  for (size_t i = 0; i < words.size(); ++i) std::memcpy(&bytes[i * pixel_bytes], &words[i], pixel_bytes);
  return bytes;
}

const char* raw_extension(PixelFormat format) {
  if (format == PixelFormat::kRgb565) return "rgb565";
  return format == PixelFormat::kRgb10a2 ? "rgb10a2" : "rgba";
}

Result<void> write_png(const std::string& path, std::span<const uint32_t> words, uint32_t width,
                       uint32_t height, PixelFormat format, bool replace) {
  const FormatTraits& bits = traits(format);
  const bool alpha = format == PixelFormat::kRgba8 || format == PixelFormat::kRgb10a2;
  const uint32_t depth = format == PixelFormat::kRgb10a2 ? 16 : 8;
  const uint32_t channels = alpha ? 4 : 3;
  std::vector<uint16_t> samples;
  samples.reserve(words.size() * channels);
  for (const uint32_t word : words)
    for (uint32_t c = 0; c < channels; ++c) {
      const int index = static_cast<int>(c);
      samples.push_back(
          static_cast<uint16_t>(widen(channel(bits, word, index), bits.channel_bits[c], depth)));
    }

  const auto library = image_library();
  if (!library) return library.error();
  const std::vector<uint8_t> bytes(samples.begin(), samples.end());
  PngPixels pixels{.width = width, .height = height, .channels = channels, .channel_bits = depth};
  pixels.samples = depth == 16 ? static_cast<const void*>(samples.data()) : bytes.data();
  // Into memory first: OpenImageIO does not report a full disk.
  const std::vector<uint8_t> png = (*library)->encode_png(pixels);
  if (png.empty()) return Error{ErrorKind::kSystem, path + ": cannot be encoded"};
  return write_whole_file(path, {reinterpret_cast<const char*>(png.data()), png.size()}, replace);
}

}  // namespace tilepress
