// CSV rows: the records of an RFC 4180 file, and as rows of a table with fields found by the header's names.
#pragma once

#include <cstddef>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tilepress/csv_table.h"
#include "tilepress/result.h"

namespace tilepress {

/// Walks over `text`, which must outlive the reader. A record ends with a newline ("\n" or "\r\n") outside
/// quotes. Text after the last newline is a record that is still being written: the reader skips it.
class CsvReader {
 public:
  explicit CsvReader(std::string_view text) : text_(text) {}
  /// Reads the next complete record; false at the end.
  bool next(std::vector<std::string>& fields);
  /// First byte after the last record that next() read.
  size_t offset() const { return offset_; }
  /// Number of that record. The header is record 1.
  size_t record() const { return record_; }

 private:
  std::string_view text_;
  size_t offset_ = 0;
  size_t record_ = 0;
};

/// Walks over the records after the header. `text` must outlive this.
class CsvRecords {
 public:
  explicit CsvRecords(std::string_view text) : reader_(text) { reader_.next(header_); }
  /// Goes to the next complete record; false at the end.
  bool next() { return reader_.next(fields_); }
  /// First byte after the current record.
  size_t offset() const { return reader_.offset(); }
  /// The place of a column. Of two columns with one name the last counts.
  std::optional<size_t> find(std::string_view name) const;
  /// The current record's field at this place; null if the record is shorter.
  const std::string* field(size_t place) const { return place < fields_.size() ? &fields_[place] : nullptr; }
  /// "record N: name: reason", about the current record.
  Error fault(std::string_view name, const std::string& reason) const;

 private:
  CsvReader reader_;
  std::vector<std::string> header_, fields_;
};

/// Reads the columns of a table. `records` and `columns` must outlive this.
template <class Row>
class CsvRowReader {
 public:
  CsvRowReader(const CsvRecords& records, std::span<const CsvColumn<Row>> columns) : records_(records) {
    for (const CsvColumn<Row>& column : columns)
      if (column.read != nullptr) columns_.push_back({&column, records.find(column.name)});
  }
  /// Reads the current record. Text in `row` refers to the record until the next one.
  Result<void> read(Row& row) const {
    for (const auto& [column, place] : columns_) {
      if (column->optional && !place) continue;
      const std::string* field = place ? records_.field(*place) : nullptr;
      if (field == nullptr) return records_.fault(column->name, "the field is missing");
      if (column->optional && field->empty()) continue;
      if (!column->read(*field, row)) return records_.fault(column->name, "cannot read '" + *field + "'");
    }
    return {};
  }

 private:
  struct Placed {
    const CsvColumn<Row>* column;
    std::optional<size_t> place;
  };
  const CsvRecords& records_;
  std::vector<Placed> columns_;
};

/// Calls visit(row) for each record of a file that can be read as a row. A missing file has none. Text in
/// `row` lives as long as the call.
template <class Row, class Visit>
void for_each_csv_row(const std::string& path, std::span<const CsvColumn<Row>> columns, const Visit& visit) {
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  CsvRecords records(text);
  const CsvRowReader<Row> reader(records, columns);
  while (records.next())
    if (Row row; reader.read(row)) visit(row);
}

}  // namespace tilepress
