// HTML text: small pieces of text that every section of the report page uses.
#include "html_text.h"

#include <fmt/format.h>

#include <cmath>

namespace tilepress {

std::string escape_html(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string escape_json(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    // '<' too: "</script>" inside a string would end the element.
    if (c == '"' || c == '\\' || c == '<' || byte < 0x20)
      out += fmt::format("\\u{:04x}", byte);
    else
      out += c;
  }
  return out;
}

std::string file_slug(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '.' || c == '-' || c == '_';
    out += plain ? c : '_';
  }
  return out.empty() ? "run" : out;
}

std::string shown_number(double value) {
  if (std::isnan(value)) return "–";
  const double size = std::abs(value);
  if (size >= 1000) return fmt::format("{:.0f}", value);
  return size >= 100 ? fmt::format("{:.1f}", value) : fmt::format("{:.3f}", value);
}

std::string shown_percent(double share) {
  return std::isnan(share) ? "–" : fmt::format("{:.1f} %", share * 100);
}

std::string fill_slots(std::string_view pattern,
                       const std::map<std::string, std::string, std::less<>>& slots) {
  std::string out;
  while (true) {
    const size_t open = pattern.find("{{");
    const size_t close = open == std::string_view::npos ? open : pattern.find("}}", open);
    if (close == std::string_view::npos) return out.append(pattern);
    out.append(pattern.substr(0, open));
    if (const auto slot = slots.find(pattern.substr(open + 2, close - open - 2)); slot != slots.end())
      out += slot->second;
    pattern.remove_prefix(close + 2);
  }
}

}  // namespace tilepress
