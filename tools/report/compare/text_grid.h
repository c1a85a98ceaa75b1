// Text grid: a table for a terminal or as Markdown.
#pragma once

#include <string>
#include <vector>

namespace tilepress {

using TextRow = std::vector<std::string>;

struct TextGrid {
  std::string heading;  ///< empty: no heading
  TextRow header;
  std::vector<TextRow> rows;
  size_t text_columns = 1;  ///< leading columns that are aligned left
};

/// Columns as wide as their longest cell. UTF-8 counts by character.
std::string grid_text(const TextGrid& grid, bool markdown);

}  // namespace tilepress
