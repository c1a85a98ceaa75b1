// Printable: text from files, made safe for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace tilepress {

/// `text` with '?' for each control character: text from a file must not send escape sequences to a terminal.
inline std::string printable(std::string_view text) {
  std::string safe(text);
  for (char& c : safe)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return safe;
}

}  // namespace tilepress
