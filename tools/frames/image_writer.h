// Image writer: pixel words to PNG or raw files.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "tilepress/pixel_format.h"

namespace tilepress {

/// Memory bytes of `words`, tight: 2 or 4 a pixel, little-endian.
std::string native_bytes(std::span<const uint32_t> words, PixelFormat format);

/// Name ending of a raw file of the format: "rgba", "rgb565", "rgb10a2".
const char* raw_extension(PixelFormat format);

/// Writes a PNG, alpha as it is (unassociated). 8 bits a channel; RGB565 widened to 8, RGB10A2 to 16, each by
/// repeating its high bits, so that the words can be told from it. An existing file is replaced only with
/// `replace`. False and one line in `error`.
bool write_png(const std::string& path, std::span<const uint32_t> words, uint32_t width, uint32_t height,
               PixelFormat format, bool replace, std::string& error);

}  // namespace tilepress
