// Study table: one pass over the file with the CSV reader.
#include "study/figures/study_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tilepress/csv_rows.h"
#include "tilepress/whole_file.h"

namespace tilepress {

Result<StudyTable> StudyTable::read(const std::string& path) {
  const auto text = read_whole_file(path);
  if (!text) return Error{ErrorKind::kFile, path + ": cannot be opened"};
  CsvReader records(*text);
  StudyTable table;
  if (!records.next(table.header)) return Error{ErrorKind::kFile, path + ": has no header row"};
  for (std::vector<std::string> fields; records.next(fields); table.rows.push_back(fields))
    if (fields.size() != table.header.size())
      return Error{ErrorKind::kFile, fmt::format("{}: record {} has {} fields, the header has {}", path,
                                                 records.record(), fields.size(), table.header.size())};
  return table;
}

std::string StudyTable::csv() const {
  std::string out;
  append_record(header, std::identity(), out);
  for (const auto& row : rows) append_record(row, std::identity(), out);
  return out;
}

bool StudyTable::has(std::string_view column) const {
  return std::ranges::find(header, column) != header.end();
}

const std::string& StudyTable::text(size_t row, std::string_view column) const {
  static const std::string kEmpty;
  const auto place = std::ranges::find(header, column);
  return place == header.end() ? kEmpty : rows[row][static_cast<size_t>(place - header.begin())];
}

double StudyTable::number(size_t row, std::string_view column) const {
  return number_or_nan(text(row, column));
}

std::vector<std::string> StudyTable::distinct(std::string_view column) const {
  std::vector<std::string> out;
  for (size_t row = 0; row < rows.size(); ++row)
    if (const std::string& cell = text(row, column); std::ranges::find(out, cell) == out.end())
      out.push_back(cell);
  return out;
}

double number_or_nan(std::string_view text) {
  double value = 0;
  return read_csv(text, value) ? value : NAN;
}

}  // namespace tilepress
