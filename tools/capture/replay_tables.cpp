// Replay tables: rates by trace and by category.
#include "capture/replay_tables.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "counted.h"
#include "printable.h"
#include "streams/output_file.h"
#include "tilepress/csv_rows.h"

namespace tilepress {
namespace {

using Row = std::vector<std::string>;

/// "all" for the mean over all traces.
std::string mean_label(const std::string& category) {
  return category.empty() ? "all" : category;
}

/// Aligns the first two columns to the left and the others to the right.
std::string aligned(const std::vector<Row>& rows) {
  std::vector<size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string out;
  for (const Row& row : rows) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i)
      line += (i == 0 ? "" : "  ") +
              (i < 2 ? fmt::format("{:<{}}", row[i], widths[i]) : fmt::format("{:>{}}", row[i], widths[i]));
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

std::vector<std::string> scheme_columns(const std::vector<RateRow>& rows) {
  std::vector<std::string> names;
  for (const RateRow& row : rows)
    if (!row.scheme.empty() && std::ranges::find(names, row.scheme) == names.end()) names.push_back(row.scheme);
  return names;
}

std::string time_text(const RateRow& row) {
  if (row.status == "kept") return "kept";
  return row.seconds > 0 ? fmt::format("{:.1f} s", row.seconds) : "-";
}

/// The line of the trace whose rows begin at `first`.
Row trace_line(const std::vector<RateRow>& rows, size_t first, const std::vector<std::string>& schemes) {
  const RateRow& row = rows[first];
  Row line = {printable(row.trace) + (row.is_whole() ? "" : " (!)"), row.category,
              std::to_string(row.frames_wanted), std::to_string(row.frames_captured), time_text(row)};
  for (const std::string& scheme : schemes) {
    const auto same = [&](const RateRow& other) { return other.trace == row.trace && other.scheme == scheme; };
    const auto found = std::find_if(rows.begin(), rows.end(), same);
    line.push_back(found == rows.end() || found->rate <= 0 ? "-" : fmt::format("{:.4f}", found->rate));
  }
  return line;
}

namespace category_csv {
using Row = CategoryMean;
constexpr CsvColumn<Row> kColumns[] = {
    TILEPRESS_CSV_FIGURE("category", mean_label(row.category)),
    csv_column<Row, &Row::scheme>("scheme"),
    csv_column<Row, &Row::traces>("traces"),
    csv_column<Row, &Row::rate_payload>("rate_payload"),
    csv_column<Row, &Row::rate>("rate"),
};
}  // namespace category_csv

/// While it lives, no other process changes the tables of the folder.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder) : fd_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (fd_ >= 0 && flock(fd_, LOCK_EX) != 0) { /* a file system without locks: the last process wins */
    }
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() {
    if (fd_ >= 0) close(fd_);
  }

 private:
  const int fd_;
};

/// The rows of replay.csv, without those of `traces` and of runs that have been removed. A file that cannot be
/// read has none.
std::vector<RateRow> rows_of_others(const std::string& folder, const std::vector<RateRow>& own) {
  std::vector<RateRow> rows;
  for_each_csv_row(folder + "/replay.csv", rate_columns(), [&](const RateRow& row) {
    std::error_code code;
    if (std::ranges::count(own, row.trace, &RateRow::trace) == 0 &&
        (row.scheme.empty() || std::filesystem::exists(folder + "/" + row.trace, code)))
      rows.push_back(row);
  });
  return rows;
}

}  // namespace

std::string rate_table(const std::vector<RateRow>& rows, const std::string& unit) {
  const std::vector<std::string> schemes = scheme_columns(rows);
  std::vector<Row> lines = {{unit, "category", "frames", "captured", "time"}};
  lines[0].insert(lines[0].end(), schemes.begin(), schemes.end());
  for (size_t i = 0; i < rows.size(); ++i)
    if (i == 0 || rows[i].trace != rows[i - 1].trace) lines.push_back(trace_line(rows, i, schemes));
  const std::vector<CategoryMean> means = category_means(rows);
  for (size_t i = 0; i < means.size();) {
    if (means[i].category.empty() && means[i].traces < 2) break;  // the mean over one trace is that trace
    Row line = {"harmonic mean", mean_label(means[i].category), "(" + counted(means[i].traces, unit) + ")",
                "", ""};
    const std::string& category = means[i].category;
    std::vector<std::string> cells(schemes.size(), "-");
    for (; i < means.size() && means[i].category == category; ++i) {
      const auto column = std::find(schemes.begin(), schemes.end(), means[i].scheme) - schemes.begin();
      cells[static_cast<size_t>(column)] = fmt::format("{:.4f}", means[i].rate);
    }
    line.insert(line.end(), cells.begin(), cells.end());
    lines.push_back(std::move(line));
  }
  return aligned(lines);
}

Result<void> write_replay_csv(const std::string& folder, std::vector<RateRow> rows) {
  const FolderLock lock(folder);
  const std::vector<RateRow> others = rows_of_others(folder, rows);
  if (!others.empty()) {
    rows.insert(rows.end(), others.begin(), others.end());
    std::ranges::stable_sort(rows, {}, &RateRow::trace);  // the same file whichever process ends last
  }
  std::string traces = csv_header(rate_columns()), categories = csv_header(category_csv::kColumns);
  for (const RateRow& row : rows) append_csv_row(rate_columns(), row, traces);
  for (const CategoryMean& mean : category_means(rows)) append_csv_row(category_csv::kColumns, mean, categories);
  const auto written = write_whole_file(folder + "/replay.csv", traces, true);
  return written ? write_whole_file(folder + "/categories.csv", categories, true) : written;
}

}  // namespace tilepress
