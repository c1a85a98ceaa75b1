// CSV reader: the records of an RFC 4180 file, and where each record ends.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace tilepress
