// Palette file: one colour a line, #RRGGBB or #RRGGBBAA.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tilepress {

constexpr uint32_t kLargestPalette = 1024;

/// Reads the colours as RGBA8 pixel words in the order of the file; colours without alpha get 255. Empty
/// lines and spaces around a colour are skipped. On failure returns false, and `error` names the fault and
/// its line.
bool read_palette_file(const std::string& path, std::vector<uint32_t>& colors, std::string& error);

}  // namespace tilepress
