// CSV rows: columns by name, and faults that name record and column.
#include "tilepress/csv_rows.h"

#include <algorithm>

namespace tilepress {

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
