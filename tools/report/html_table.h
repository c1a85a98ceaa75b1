// HTML table: tables whose cells carry their exact value for the CSV download.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tilepress {

/// What people see, and the exact text that the CSV download takes.
struct Cell {
  std::string html;
  std::string exact;
};
Cell text_cell(std::string_view text);
Cell count_cell(uint64_t count);
Cell number_cell(double value);
Cell percent_cell(double share);

struct Table {
  std::string id;
  std::string caption;
  std::vector<std::string> header;
  size_t text_columns = 1;  ///< leading columns that hold text; the first is the row's header
  std::vector<std::vector<Cell>> rows;
};
std::string table_html(const Table& table);
/// The button that downloads the table with element id `table_id` as `file`.
std::string csv_button(std::string_view table_id, std::string_view file);

}  // namespace tilepress
