// Result rows: common columns by their table, columns of single schemes by name.
#include "result_rows.h"

#include <algorithm>

#include "tilepress/csv_rows.h"
#include "tilepress/run_info.h"
#include "tilepress/scheme.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {
namespace {

/// A column that a file may lack and a row may leave empty.
class OptionalColumn {
 public:
  OptionalColumn(const CsvRecords& records, std::string_view name)
      : records_(records), name_(name), place_(records.find(name)) {}
  template <class T>
  Result<std::optional<T>> read() const {
    const std::string* field = place_ ? records_.field(*place_) : nullptr;
    if (field == nullptr || field->empty()) return std::optional<T>();
    T value{};
    if (!read_csv(*field, value)) return records_.fault(name_, "cannot read '" + *field + "'");
    return std::optional(value);
  }

 private:
  const CsvRecords& records_;
  std::string_view name_;
  std::optional<size_t> place_;
};

class RowSums {
 public:
  RowSums(std::string_view text, uint32_t burst_bits, bool with_frames)
      : records_(text), with_frames_(with_frames) {
    sums_.total.burst_bits = burst_bits;
    sums_.own.resize(names_.size());
    for (const std::string_view name : names_) own_.emplace_back(records_, name);
  }

  Result<ResultSums> read() {
    const CsvRowReader<SchemeRow> reader(records_, scheme_columns());
    while (records_.next()) {
      SchemeRow row;
      row.figures.burst_bits = sums_.total.burst_bits;
      if (const auto done = reader.read(row); !done) return done.error();
      if (row.warmup || is_target(row.surface)) continue;
      if (const auto done = add(row); !done) return done.error();
    }
    return std::move(sums_);
  }

 private:
  Result<void> add(const SchemeRow& row) {
    ++sums_.frames;
    sums_.total += row.figures;
    const auto coverage = coverage_.read<double>(), relative = relative_.read<double>();
    if (!coverage || !relative) return (coverage ? relative : coverage).error();
    if (*coverage) sums_.fvc_coverage.add(**coverage);
    if (*relative) sums_.fvc_relative_coverage.add(**relative);
    if (with_frames_)
      sums_.each.push_back({row.frame, row.surface, row.figures.rate(), row.figures.rate_payload(), *coverage});
    return add_own(row);
  }

  Result<void> add_own(const SchemeRow& row) {
    const SchemeInfo* info = find_scheme(row.scheme.substr(0, row.scheme.find(':')));
    if (info == nullptr) return {};
    for (size_t i = 0; i < names_.size(); ++i) {
      const auto columns = info->own_columns();
      if (std::ranges::find(columns, names_[i]) == columns.end()) continue;
      const auto count = own_[i].read<uint64_t>();
      if (!count) return count.error();
      if (*count) sums_.own[i] = sums_.own[i].value_or(0) + **count;
    }
    return {};
  }

  CsvRecords records_;
  const bool with_frames_;
  const std::vector<std::string_view> names_ = own_column_names();
  std::vector<OptionalColumn> own_;
  const OptionalColumn coverage_{records_, "fvc_coverage"}, relative_{records_, "fvc_relative_coverage"};
  ResultSums sums_;
};

}  // namespace

std::vector<std::string_view> own_column_names() {
  std::vector<std::string_view> names;
  for (const SchemeInfo& info : scheme_registry())
    for (const char* column : info.own_columns())
      if (std::ranges::find(names, column) == names.end()) names.emplace_back(column);
  return names;
}

Result<ResultSums> sum_result_rows(std::string_view text, uint32_t burst_bits, bool with_frames) {
  return RowSums(text, burst_bits, with_frames).read();
}

}  // namespace tilepress
