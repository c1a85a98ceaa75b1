// Printable: text from files, made safe for a terminal.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace tilepress {

/// `text` with '?' for each control character: text from a file must not send escape sequences to a terminal.
inline std::string printable(std::string_view text) {
  std::string safe(text);
  for (char& c : safe)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return safe;
}

/// The last lines of another program, each as "  said: LINE", behind the message that it failed.
inline std::string last_words(const std::vector<std::string>& lines) {
  std::string text;
  for (size_t i = lines.size() - std::min<size_t>(lines.size(), 5); i < lines.size(); ++i)
    text += "  said: " + printable(lines[i]) + "\n";
  return text;
}

}  // namespace tilepress
