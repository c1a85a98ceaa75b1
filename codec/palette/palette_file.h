// Palette file: one colour a line, #RRGGBB or #RRGGBBAA.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

constexpr uint32_t kLargestPalette = 1024;

/// Reads the colours as RGBA8 pixel words in the order of the file. Colours without alpha get 255. Skips
/// empty lines and spaces around a colour. An error names the fault and its line.
Result<std::vector<uint32_t>> read_palette_file(const std::string& path);

}  // namespace tilepress
