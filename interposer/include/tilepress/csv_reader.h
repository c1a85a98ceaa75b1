// CSV reader: the records of an RFC 4180 file, with where each one ends.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tilepress {

/// Walks over `text`, which must outlive the reader. A record ends with a newline ("\n" or "\r\n") outside
/// quotes; what stands after the last one is a record still being written and is never given out.
class CsvReader {
 public:
  explicit CsvReader(std::string_view text) : text_(text) {}
  /// Next complete record; false at the end.
  bool next(std::vector<std::string>& fields);
  /// First byte after the last record given out.
  size_t offset() const { return offset_; }
  /// Number of the record last given out, the header being 1.
  size_t record() const { return record_; }

 private:
  std::string_view text_;
  size_t offset_ = 0;
  size_t record_ = 0;
};

}  // namespace tilepress
