// Text grid: widths first, then lines.
#include "report/compare/text_grid.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepress {
namespace {

size_t shown_width(const std::string& text) {
  return static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, size_t width, bool right) {
  const std::string space(width - std::min(width, shown_width(text)), ' ');
  return right ? space + text : text + space;
}

}  // namespace

std::string grid_text(const TextGrid& grid, bool markdown) {
  std::vector<size_t> widths;
  for (size_t i = 0; i < grid.header.size(); ++i) {
    size_t width = std::max<size_t>(3, shown_width(grid.header[i]));
    for (const TextRow& row : grid.rows) width = std::max(width, shown_width(row[i]));
    widths.push_back(width);
  }
  const auto line = [&](const TextRow& row) {
    std::string out = markdown ? "|" : "";
    for (size_t i = 0; i < row.size(); ++i) {
      out += markdown ? " " : (i > 0 ? "  " : "");
      out += padded(row[i], widths[i], i >= grid.text_columns);
      if (markdown) out += " |";
    }
    while (!out.empty() && out.back() == ' ') out.pop_back();
    return out + "\n";
  };
  std::string out;
  if (!grid.heading.empty())
    out = fmt::format("\n{}{}\n{}", markdown ? "### " : "", grid.heading, markdown ? "\n" : "");
  out += line(grid.header);
  if (markdown) {
    out += "|";
    for (size_t i = 0; i < widths.size(); ++i)
      out += i < grid.text_columns ? fmt::format(" {:-<{}} |", "", widths[i])
                                   : fmt::format(" {:->{}} |", ":", widths[i]);
    out += "\n";
  }
  for (const TextRow& row : grid.rows) out += line(row);
  return out;
}

}  // namespace tilepress
