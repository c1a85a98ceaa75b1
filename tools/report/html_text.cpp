// HTML text: small pieces of text that every section of the report page uses.
#include "html_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "tilepress/csv_table.h"

namespace tilepress {

constexpr size_t kDenseColumns = 14;  ///< a table with more is set smaller

/// A column's name as people read it: "pixel change" for "pixel_change". Names of configurations stay.
static std::string heading_of(std::string name) {
  if (name.find('=') == std::string::npos) std::replace(name.begin(), name.end(), '_', ' ');
  return escape_html(name);
}

std::string replaced(std::string_view text,
                     std::initializer_list<std::pair<std::string_view, std::string_view>> list) {
  std::string out;
  while (!text.empty()) {
    const auto found =
        std::ranges::find_if(list, [&](const auto& entry) { return text.starts_with(entry.first); });
    out += found == list.end() ? text.substr(0, 1) : found->second;
    text.remove_prefix(found == list.end() ? 1 : found->first.size());
  }
  return out;
}

std::string escape_html(std::string_view text) {
  return replaced(text, {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}});
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

std::string file_slug(std::string_view text, std::string_view kept) {
  std::string out(text);
  for (char& c : out)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && kept.find(c) == kept.npos) c = '_';
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
  return {std::string(text), std::string(text)};
}
Cell count_cell(uint64_t count) {
  return text_cell(std::to_string(count));
}
Cell number_cell(double value) {
  return {shown_number(value), exact_cell(value).exact};
}
Cell exact_cell(double value) {
  return text_cell(std::isfinite(value) ? csv_number(value) : "");
}
Cell percent_cell(double share) {
  return {shown_percent(share), exact_cell(share).exact};
}

bool Table::wraps(size_t column) const {
  return std::find(wrapped.begin(), wrapped.end(), column) != wrapped.end();
}

std::string table_html(const Table& table) {
  std::string out =
      fmt::format("<div class=\"scroll\" tabindex=\"0\"><table class=\"figures{}\" id=\"table-{}\">",
                  table.header.size() > kDenseColumns ? " dense" : "", table.name);
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
      std::string html = row[i].html.empty() ? escape_html(row[i].shown) : row[i].html;
      if (table.wraps(i) && !html.empty()) html = "<span class=\"wrap\">" + html + "</span>";
      // Narrow screens do not show the header row: each cell names its column.
      out += fmt::format("<{}{}{} data-h=\"{}\" data-v=\"{}\">{}</{}>", tag, i == 0 ? " scope=\"row\"" : "",
                         i < table.text_columns ? " class=\"text\"" : "", heading_of(table.header[i]),
                         escape_html(row[i].exact), html, tag);
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string csv_button(std::string_view table_name, std::string_view file) {
  return fmt::format(
      "<button type=\"button\" class=\"save\" data-table=\"table-{}\" data-file=\"{}\">Download "
      "CSV</button>\n",
      table_name, escape_html(file));
}

}  // namespace tilepress
