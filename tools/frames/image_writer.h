// Image writer: pixel words to PNG or raw files.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "tilepress/pixel_format.h"
#include "tilepress/result.h"

namespace tilepress {

/// The memory bytes of `words`, tight: 2 or 4 per pixel, little-endian.
std::string native_bytes(std::span<const uint32_t> words, PixelFormat format);

/// Name ending of a raw file of the format: "rgba", "rgb565", "rgb10a2".
const char* raw_extension(PixelFormat format);

/// Writes a PNG of 8 bits a channel, alpha as it is (unassociated). RGB565 is widened to 8 bits and RGB10A2 to
/// 16, by repeating the high bits of each channel, so that the words can be computed back. Fails with kExists
/// if the file exists and `replace` is false.
Result<void> write_png(const std::string& path, std::span<const uint32_t> words, uint32_t width,
                       uint32_t height, PixelFormat format, bool replace);

}  // namespace tilepress
