// Palette file: reads and checks it.
#include "palette/palette_file.h"

#include <filesystem>
#include <fstream>
#include <optional>

namespace tilepress {
namespace {

constexpr uintmax_t kLargestFile = 1 << 16;  // 1024 lines have room for 64 bytes each

std::optional<uint32_t> hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

std::optional<uint32_t> parse_color(const std::string& text) {
  if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
  uint32_t word = text.size() == 7 ? 0xFF000000u : 0;
  for (size_t i = 1; i < text.size(); i += 2) {
    const auto high = hex_digit(text[i]), low = hex_digit(text[i + 1]);
    if (!high || !low) return std::nullopt;
    word |= (*high << 4 | *low) << 4 * (i - 1);  // R, G, B, A go to bytes 0, 1, 2, 3
  }
  return word;
}

std::string printable(std::string text) {
  if (text.size() > 24) text = text.substr(0, 24) + "...";
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

}  // namespace

Result<std::vector<uint32_t>> read_palette_file(const std::string& path) {
  std::vector<uint32_t> colors;
  std::error_code status;
  const auto fail = [](std::string text) { return Error{ErrorKind::kFile, std::move(text)}; };
  if (!std::filesystem::is_regular_file(path, status)) return fail("no such file");
  if (std::filesystem::file_size(path, status) > kLargestFile || status)
    return fail("no palette: larger than 64 KiB");
  std::ifstream file(path);
  if (!file) return fail("cannot be read");
  std::string line;
  for (uint32_t number = 1; std::getline(file, line); ++number) {
    const size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos) continue;
    line = line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
    const auto color = parse_color(line);
    const std::string at = "line " + std::to_string(number) + ": ";
    if (!color) return fail(at + "'" + printable(line) + "' is not #RRGGBB or #RRGGBBAA");
    if (colors.size() == kLargestPalette) return fail(at + "more than 1024 colours");
    colors.push_back(*color);
  }
  if (file.bad()) return fail("cannot be read");
  if (colors.empty()) return fail("holds no colours");
  return colors;
}

}  // namespace tilepress
