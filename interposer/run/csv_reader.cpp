// CSV reader: one pass over the bytes, quotes as RFC 4180 has them.
#include "tilepress/csv_reader.h"

namespace tilepress {

bool CsvReader::next(std::vector<std::string>& fields) {
  fields.clear();
  fields.emplace_back();
  bool quoted = false;
  for (size_t i = offset_; i < text_.size(); ++i) {
    const char c = text_[i];
    if (quoted) {
      if (c != '"') {
        fields.back() += c;
      } else if (i + 1 < text_.size() && text_[i + 1] == '"') {
        fields.back() += c;
        ++i;
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      fields.emplace_back();
    } else if (c == '\n') {
      offset_ = i + 1;
      ++record_;
      return true;
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  fields.clear();
  return false;
}

}  // namespace tilepress
