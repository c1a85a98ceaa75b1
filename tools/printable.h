// Printable: text from files, made safe for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace tilepress {

/// `text` with '?' for each control character, so that a file cannot send a terminal escape sequences.
inline std::string printable(std::string_view text) {
  std::string safe(text);
  for (char& c : safe)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return safe;
}

}  // namespace tilepress
