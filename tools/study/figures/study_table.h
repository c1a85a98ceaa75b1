// Study table: the rows of a CSV file by column names.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/csv_table.h"
#include "tilepress/result.h"

namespace tilepress {

/// Appends an RFC 4180 record of the text of each cell.
template <class Cells, class TextOf>
void append_record(const Cells& cells, TextOf text_of, std::string& out) {
  for (size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) out += ',';
    append_csv(out, std::invoke(text_of, cells[i]));
  }
  out += '\n';
}

/// The number that the whole text is. NaN for other texts.
double number_or_nan(std::string_view text);

struct StudyTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  /// Fails with kFile if `path` cannot be read or a record has more or fewer fields than the header.
  static Result<StudyTable> read(const std::string& path);
  /// RFC 4180, with the header row.
  std::string csv() const;

  size_t row_count() const { return rows.size(); }
  bool has(std::string_view column) const;
  /// The cell's text. Empty if the table lacks the column.
  const std::string& text(size_t row, std::string_view column) const;
  /// The cell's number. NaN if the cell holds none.
  double number(size_t row, std::string_view column) const;
  /// The texts of a column, each once, in the order they first appear.
  std::vector<std::string> distinct(std::string_view column) const;
};

}  // namespace tilepress
