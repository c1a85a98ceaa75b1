// HTML text: escaping, shown numbers, template slots, and tables whose cells carry exact values for CSV.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tilepress {

/// `text` with & < > " ' replaced, fit for element text and quoted attributes.
std::string escape_html(std::string_view text);
/// `text` as the inside of a JSON string that may stand in a script element.
std::string escape_json(std::string_view text);
/// `text` as part of a file name or element id: letters, digits, '.', '-' and '_' stay, others become '_'.
std::string file_slug(std::string_view text);
/// Three decimals, or fewer digits for large values; "–" for NaN.
std::string shown_number(double value);
/// A share of 0..1 as a percentage with one decimal; "–" for NaN.
std::string shown_percent(double share);

/// Replaces each {{name}} of `pattern` by its slot, or by nothing if there is no such slot.
std::string fill_slots(std::string_view pattern,
                       const std::map<std::string, std::string, std::less<>>& slots);

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
