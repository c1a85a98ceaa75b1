// HTML text: escaping, shown numbers, template slots, and tables whose cells carry exact values for CSV.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tilepress {

/// `text` with each first text of `list` replaced by the second.
std::string replaced(std::string_view text,
                     std::initializer_list<std::pair<std::string_view, std::string_view>> list);
/// `text` with & < > " ' replaced, fit for element text and quoted attributes.
std::string escape_html(std::string_view text);
/// `text` as the inside of a JSON string that may stand in a script element.
std::string escape_json(std::string_view text);
/// `text` as part of a file name or element id: letters, digits, '_' and the characters of `kept` stay,
/// others become '_'. "run" for an empty text.
std::string file_slug(std::string_view text, std::string_view kept = ".-");
/// Three decimals, or fewer digits for large values; "–" for NaN.
std::string shown_number(double value);
/// A share of 0..1 as a percentage with one decimal; "–" for NaN.
std::string shown_percent(double share);

/// Replaces each {{name}} of `pattern` by its slot, or by nothing if there is no such slot.
std::string fill_slots(std::string_view pattern,
                       const std::map<std::string, std::string, std::less<>>& slots);

/// What people see, and the exact text that CSV takes.
struct Cell {
  std::string shown, exact;
  std::string html{};  ///< of `shown`, unless it is the plain text
};
Cell text_cell(std::string_view text);
Cell count_cell(uint64_t count);
/// Three decimals or fewer are shown. Empty for NaN.
Cell number_cell(double value);
/// All digits of `value` are shown. Empty for NaN.
Cell exact_cell(double value);
/// A share of 0..1 in percent. Empty for NaN.
Cell percent_cell(double share);

struct Table {
  std::string name{};     ///< of files; "table-NAME" is the element's id
  std::string caption{};  ///< a sentence
  std::vector<std::string> header{};
  size_t text_columns = 1;  ///< leading columns that hold text; the first is the row's header
  std::vector<std::vector<Cell>> rows{};
  std::vector<size_t> wrapped{};  ///< columns of text that may take several lines
  std::string note{};             ///< below the table of a document; may be empty

  bool wraps(size_t column) const;
};
std::string table_html(const Table& table);
/// The button that downloads a table as `file`.
std::string csv_button(std::string_view table_name, std::string_view file);

}  // namespace tilepress
