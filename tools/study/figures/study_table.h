// Study table: a CSV file of a study, read by column names.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/result.h"

namespace tilepress {

/// The records of one file. A default table has no rows.
class StudyTable {
 public:
  /// Fails with kFile if `path` cannot be read or a record has more or fewer fields than the header.
  static Result<StudyTable> read(const std::string& path);

  size_t row_count() const { return rows_.size(); }
  bool has(std::string_view column) const { return columns_.contains(column); }
  /// The cell's text. Empty if the file lacks the column.
  const std::string& text(size_t row, std::string_view column) const;
  /// The cell's number. NaN if the cell holds none.
  double number(size_t row, std::string_view column) const;

 private:
  std::map<std::string, size_t, std::less<>> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace tilepress
