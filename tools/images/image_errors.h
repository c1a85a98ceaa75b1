// Image errors: what readers say about a file. Each text follows the name of the file and a colon.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "tilepress/result.h"

namespace tilepress {

/// The first line of what a library says, without its full stop.
inline std::string first_line(std::string_view text) {
  text = text.substr(0, std::min(text.find('\n'), text.size()));
  while (text.ends_with('.') || text.ends_with(' ')) text.remove_suffix(1);
  return std::string(text);
}

/// The error that a library reports.
inline Error library_error(std::string_view text) {
  const std::string line = first_line(text);
  return {ErrorKind::kFile, line.empty() ? "cannot be decoded" : line};
}

/// `details`: what a library says about the damage, or nothing.
inline Error damaged(std::string_view details = {}) {
  const std::string line = first_line(details);
  return {ErrorKind::kFile, "is damaged or cut off" + (line.empty() ? "" : ": " + line)};
}

inline Error cut_off() {
  return {ErrorKind::kFile, "is cut off"};
}

inline Error changed_file() {
  return {ErrorKind::kFile, "has changed since it was first looked at"};
}

inline Error unsupported(std::string text) {
  return {ErrorKind::kUnsupported, std::move(text)};
}

/// For samples of more than 8 bits. `type`: "uint16", "half" and the like.
inline Error deep_channels(const std::string& type) {
  return unsupported("has " + type + " channels; only 8 bits a channel are taken, nothing is narrowed");
}

}  // namespace tilepress
