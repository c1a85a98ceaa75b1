// CSV rows: columns by name, and faults that name record and column.
#include "tilepress/csv_rows.h"

#include <algorithm>

namespace tilepress {

// One pass over the bytes, with the quotes of RFC 4180.
bool CsvReader::next(std::vector<std::string>& fields) {
  size_t count = 0;
  const auto begin_field = [&] {  // reuses the memory of the record before
    if (count < fields.size())
      fields[count].clear();
    else
      fields.emplace_back();
    ++count;
  };
  begin_field();
  bool quoted = false;
  for (size_t i = offset_; i < text_.size(); ++i) {
    const size_t begin = i;
    while (i < text_.size() && text_[i] != '"' &&
           (quoted || (text_[i] != ',' && text_[i] != '\n' && text_[i] != '\r')))
      ++i;
    std::string& field = fields[count - 1];
    field.append(text_.substr(begin, i - begin));
    if (i == text_.size()) break;
    const char c = text_[i];
    if (c == '"') {
      if (quoted && i + 1 < text_.size() && text_[i + 1] == '"')
        field += text_[++i];
      else
        quoted = !quoted;
    } else if (c == ',') {
      begin_field();
    } else if (c == '\n') {
      offset_ = i + 1;
      ++record_;
      fields.resize(count);
      return true;
    }
  }
  fields.clear();
  return false;
}

std::optional<size_t> CsvRecords::find(std::string_view name) const {
  const auto found = std::find(header_.rbegin(), header_.rend(), name);
  if (found == header_.rend()) return std::nullopt;
  return static_cast<size_t>(header_.rend() - found) - 1;
}

Error CsvRecords::fault(std::string_view name, const std::string& reason) const {
  return {ErrorKind::kFile,
          "record " + std::to_string(reader_.record()) + ": " + std::string(name) + ": " + reason};
}

}  // namespace tilepress
