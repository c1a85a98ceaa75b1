// Replay tables: rates by trace and by category.
#include "capture/replay_tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "printable.h"
#include "streams/output_file.h"
#include "tilepress/csv_table.h"

namespace tilepress {
namespace {

const char* status_text(ReplayStatus status) {
  static constexpr const char* kTexts[] = {"not replayed", "done",        "kept",
                                           "failed",       "interrupted", "nothing captured"};
  return kTexts[static_cast<size_t>(status)];
}

std::string category_label(const std::string& category) {
  return category.empty() ? "all" : category;
}

using Row = std::vector<std::string>;

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

std::vector<std::string> scheme_columns(const std::vector<std::unique_ptr<TraceReplay>>& replays) {
  std::vector<std::string> names;
  for (const auto& replay : replays)
    for (const std::string& name : replay->result().run.scheme_names)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

std::string rate_text(const RunRecord& run, const std::string& scheme) {
  const auto found = std::find(run.scheme_names.begin(), run.scheme_names.end(), scheme);
  if (found == run.scheme_names.end() || run.measured_frames == 0) return "-";
  return fmt::format("{:.4f}", run.totals[static_cast<size_t>(found - run.scheme_names.begin())].rate());
}

/// A scheme of a trace. A trace without a run has one row, without scheme.
struct TraceRow {
  const ReplayInput& input;
  const ReplayResult& result;
  std::string scheme, rate_payload, rate;  ///< rates: empty without measured frames
};

namespace trace_csv {
using Row = TraceRow;
constexpr CsvColumn<Row> kColumns[] = {
    TILEPRESS_CSV_FIGURE("trace", row.input.name),
    TILEPRESS_CSV_FIGURE("path", row.input.path),
    TILEPRESS_CSV_FIGURE("category", row.input.category),
    TILEPRESS_CSV_FIGURE("status", status_text(row.result.status)),
    TILEPRESS_CSV_FIGURE("frames", row.result.frames_in_trace),
    TILEPRESS_CSV_FIGURE("frames_wanted", row.result.frames_wanted),
    TILEPRESS_CSV_FIGURE("frames_captured", row.result.frames_captured),
    TILEPRESS_CSV_FIGURE("seconds", row.result.seconds),
    csv_column<Row, &Row::scheme>("scheme"),
    csv_column<Row, &Row::rate_payload>("rate_payload"),
    csv_column<Row, &Row::rate>("rate"),
};
}  // namespace trace_csv

namespace category_csv {
using Row = CategoryMean;
constexpr CsvColumn<Row> kColumns[] = {
    TILEPRESS_CSV_FIGURE("category", category_label(row.category)),
    csv_column<Row, &Row::scheme>("scheme"),
    csv_column<Row, &Row::traces>("traces"),
    csv_column<Row, &Row::rate_payload>("rate_payload"),
    csv_column<Row, &Row::rate>("rate"),
};
}  // namespace category_csv

void append_trace_rows(const TraceReplay& replay, std::string& out) {
  const RunRecord& run = replay.result().run;
  TraceRow row{replay.input(), replay.result(), {}, {}, {}};
  if (run.scheme_names.empty()) append_csv_row(trace_csv::kColumns, row, out);
  for (size_t i = 0; i < run.scheme_names.size(); ++i) {
    row.scheme = run.scheme_names[i];
    if (run.measured_frames > 0) {
      row.rate_payload = csv_number(run.totals[i].rate_payload());
      row.rate = csv_number(run.totals[i].rate());
    }
    append_csv_row(trace_csv::kColumns, row, out);
  }
}

}  // namespace

std::string replay_table(const std::vector<std::unique_ptr<TraceReplay>>& replays) {
  const std::vector<std::string> schemes = scheme_columns(replays);
  std::vector<Row> rows = {{"trace", "category", "frames", "captured", "time"}};
  rows[0].insert(rows[0].end(), schemes.begin(), schemes.end());
  for (const auto& replay : replays) {
    const ReplayResult& result = replay->result();
    const bool good = result.status == ReplayStatus::kDone || result.status == ReplayStatus::kKept;
    Row row = {printable(replay->input().name) + (good ? "" : " (!)"), replay->input().category,
               std::to_string(result.frames_wanted), std::to_string(result.frames_captured),
               result.status == ReplayStatus::kKept ? "kept" : fmt::format("{:.1f} s", result.seconds)};
    for (const std::string& scheme : schemes) row.push_back(rate_text(result.run, scheme));
    rows.push_back(std::move(row));
  }
  const std::vector<CategoryMean> means = category_means(replays);
  for (size_t i = 0; i < means.size();) {
    if (means[i].category.empty() && means[i].traces < 2) break;  // the mean over one trace is that trace
    Row row = {"harmonic mean", category_label(means[i].category),
               fmt::format("({} traces)", means[i].traces), "", ""};
    const std::string& category = means[i].category;
    std::vector<std::string> cells(schemes.size(), "-");
    for (; i < means.size() && means[i].category == category; ++i) {
      const auto column = std::find(schemes.begin(), schemes.end(), means[i].scheme) - schemes.begin();
      cells[static_cast<size_t>(column)] = fmt::format("{:.4f}", means[i].rate);
    }
    row.insert(row.end(), cells.begin(), cells.end());
    rows.push_back(std::move(row));
  }
  return aligned(rows);
}

Result<void> write_replay_csv(const std::string& folder,
                              const std::vector<std::unique_ptr<TraceReplay>>& replays) {
  std::string traces = csv_header(trace_csv::kColumns), categories = csv_header(category_csv::kColumns);
  for (const auto& replay : replays) append_trace_rows(*replay, traces);
  for (const CategoryMean& mean : category_means(replays))
    append_csv_row(category_csv::kColumns, mean, categories);
  const auto written = write_whole_file(folder + "/replay.csv", traces, true);
  return written ? write_whole_file(folder + "/categories.csv", categories, true) : written;
}

}  // namespace tilepress
