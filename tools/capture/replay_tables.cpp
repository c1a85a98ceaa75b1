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

std::string trace_rows(const TraceReplay& replay) {
  const ReplayInput& input = replay.input();
  const ReplayResult& result = replay.result();
  const std::string begin =
      fmt::format("{},{},{},{},{},{},{},{}", csv_field(input.name), csv_field(input.path),
                  csv_field(input.category), status_text(result.status), result.frames_in_trace,
                  result.frames_wanted, result.frames_captured, csv_number(result.seconds));
  const RunRecord& run = result.run;
  if (run.scheme_names.empty()) return begin + ",,,\n";
  std::string rows;
  for (size_t i = 0; i < run.scheme_names.size(); ++i) {
    const bool measured = run.measured_frames > 0;
    rows += fmt::format("{},{},{},{}\n", begin, csv_field(run.scheme_names[i]),
                        measured ? csv_number(run.totals[i].rate_payload()) : "",
                        measured ? csv_number(run.totals[i].rate()) : "");
  }
  return rows;
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
  std::string traces =
      "trace,path,category,status,frames,frames_wanted,frames_captured,seconds,scheme,rate_payload,rate\n";
  for (const auto& replay : replays) traces += trace_rows(*replay);
  std::string categories = "category,scheme,traces,rate_payload,rate\n";
  for (const CategoryMean& mean : category_means(replays))
    categories += fmt::format("{},{},{},{},{}\n", category_label(mean.category), csv_field(mean.scheme),
                              mean.traces, csv_number(mean.rate_payload), csv_number(mean.rate));
  const auto written = write_whole_file(folder + "/replay.csv", traces, true);
  return written ? write_whole_file(folder + "/categories.csv", categories, true) : written;
}

}  // namespace tilepress
