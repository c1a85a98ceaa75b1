// HTML table: markup of one table.
#include "html_table.h"

#include <fmt/format.h>

#include <cmath>

#include "html_text.h"
#include "tilepress/csv_table.h"

namespace tilepress {
namespace {

constexpr size_t kDenseColumns = 14;  ///< a table with more is set smaller
/// A column name that may be broken after its underscores.
std::string breakable(std::string_view name) {
  std::string out;
  for (const char c : name) out += c == '_' ? std::string("_<wbr>") : escape_html({&c, 1});
  return out;
}

}  // namespace

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
    out += fmt::format("<th scope=\"col\"{}>{}</th>", i < table.text_columns ? " class=\"text\"" : "",
                       breakable(table.header[i]));
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (size_t i = 0; i < row.size(); ++i) {
      const char* tag = i == 0 ? "th" : "td";
      // Narrow screens do not show the header row: each cell names its column.
      out += fmt::format("<{}{}{} data-h=\"{}\" data-v=\"{}\">{}</{}>", tag, i == 0 ? " scope=\"row\"" : "",
                         i < table.text_columns ? " class=\"text\"" : "", escape_html(table.header[i]),
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
