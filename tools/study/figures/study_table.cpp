// Study table: one pass over the file with the CSV reader.
#include "study/figures/study_table.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "tilepress/csv_rows.h"
#include "tilepress/csv_table.h"

namespace tilepress {

Result<StudyTable> StudyTable::read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{ErrorKind::kFile, path + ": cannot be opened"};
  const std::string text(std::istreambuf_iterator<char>(file), {});
  CsvReader records(text);
  StudyTable table;
  std::vector<std::string> fields;
  if (!records.next(fields)) return Error{ErrorKind::kFile, path + ": has no header row"};
  for (size_t i = 0; i < fields.size(); ++i) table.columns_.emplace(fields[i], i);
  const size_t width = fields.size();
  while (records.next(fields)) {
    if (fields.size() != width)
      return Error{ErrorKind::kFile, fmt::format("{}: record {} has {} fields, the header has {}", path,
                                                 records.record(), fields.size(), width)};
    table.rows_.push_back(fields);
  }
  return table;
}

const std::string& StudyTable::text(size_t row, std::string_view column) const {
  static const std::string kEmpty;
  const auto found = columns_.find(column);
  return found == columns_.end() ? kEmpty : rows_[row][found->second];
}

double StudyTable::number(size_t row, std::string_view column) const {
  double value = 0;
  return read_csv(text(row, column), value) ? value : NAN;
}

}  // namespace tilepress
