// HTML text: small pieces of text that every section of the report page uses.
#include "html_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tilepress/csv_table.h"

namespace tilepress {

constexpr size_t kDenseColumns = 14;  ///< a table with more is set smaller

/// A column's name as people read it: "pixel change" for "pixel_change". Names of configurations stay.
static std::string heading_of(std::string name) {
  if (name.find('=') == std::string::npos) std::replace(name.begin(), name.end(), '_', ' ');
  return escape_html(name);
}

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

Cell text_cell(std::string_view text) {
  return {escape_html(text), std::string(text)};
}
Cell count_cell(uint64_t count) {
  return {std::to_string(count), std::to_string(count)};
}
Cell number_cell(double value) {
  return {shown_number(value), std::isnan(value) ? "" : csv_number(value)};
}
Cell percent_cell(double share) {
  return {shown_percent(share), std::isnan(share) ? "" : csv_number(share)};
}

std::string table_html(const Table& table) {
  std::string out = fmt::format("<div class=\"scroll\" tabindex=\"0\"><table class=\"figures{}\" id=\"{}\">",
                                table.header.size() > kDenseColumns ? " dense" : "", table.id);
  out += "<caption>" + escape_html(table.caption) + "</caption>\n<thead><tr>";
  for (size_t i = 0; i < table.header.size(); ++i)
    out += fmt::format("<th scope=\"col\"{} data-v=\"{}\">{}</th>",
                       i < table.text_columns ? " class=\"text\"" : "", escape_html(table.header[i]),
                       heading_of(table.header[i]));
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (size_t i = 0; i < row.size(); ++i) {
      const char* tag = i == 0 ? "th" : "td";
      // Narrow screens do not show the header row: each cell names its column.
      out += fmt::format("<{}{}{} data-h=\"{}\" data-v=\"{}\">{}</{}>", tag, i == 0 ? " scope=\"row\"" : "",
                         i < table.text_columns ? " class=\"text\"" : "", heading_of(table.header[i]),
                         escape_html(row[i].exact), row[i].html, tag);
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string csv_button(std::string_view table_id, std::string_view file) {
  return fmt::format(
      "<button type=\"button\" class=\"save\" data-table=\"{}\" data-file=\"{}\">Download CSV</button>\n",
      table_id, escape_html(file));
}

}  // namespace tilepress
