// Rate rows: from replays and from runs.
#include "capture/rate_rows.h"

#include <algorithm>

namespace tilepress {
namespace {

const char* status_text(ReplayStatus status) {
  static constexpr const char* kTexts[] = {"not replayed", "done",        "kept",
                                           "failed",       "interrupted", "nothing captured"};
  return kTexts[static_cast<size_t>(status)];
}

/// A rate, or an empty field for 0.
template <auto member>
constexpr CsvColumn<RateRow> rate_column(std::string_view name) {
  return {name,
          [](const RateRow& row, std::string& out) {
            if (row.*member > 0) append_csv(out, row.*member);
          },
          [](std::string_view field, RateRow& row) { return read_csv(field, row.*member); }, true};
}

constexpr CsvColumn<RateRow> kColumns[] = {
    csv_column<RateRow, &RateRow::trace>("trace"),
    csv_column<RateRow, &RateRow::path>("path"),
    csv_column<RateRow, &RateRow::category>("category"),
    csv_column<RateRow, &RateRow::status>("status"),
    csv_column<RateRow, &RateRow::frames>("frames"),
    csv_column<RateRow, &RateRow::frames_wanted>("frames_wanted"),
    csv_column<RateRow, &RateRow::frames_captured>("frames_captured"),
    csv_column<RateRow, &RateRow::seconds>("seconds"),
    csv_column<RateRow, &RateRow::scheme>("scheme"),
    rate_column<&RateRow::rate_payload>("rate_payload"),
    rate_column<&RateRow::rate>("rate"),
};

/// Appends `row` once per scheme of the run.
void append_rows(RateRow row, const RunRecord& run, std::vector<RateRow>& rows) {
  if (run.scheme_names.empty()) rows.push_back(row);
  for (size_t i = 0; i < run.scheme_names.size(); ++i) {
    row.scheme = run.scheme_names[i];
    if (run.measured_frames > 0) {
      row.rate_payload = run.totals[i].rate_payload();
      row.rate = run.totals[i].rate();
    }
    rows.push_back(row);
  }
}

void append_once(std::vector<std::string>& list, const std::string& text) {
  if (std::ranges::find(list, text) == list.end()) list.push_back(text);
}

bool is_measured(const RateRow& row) {
  return row.is_whole() && row.rate > 0 && row.rate_payload > 0;
}

}  // namespace

std::span<const CsvColumn<RateRow>> rate_columns() {
  return kColumns;
}

std::vector<RateRow> rate_rows(const std::vector<std::unique_ptr<TraceReplay>>& replays) {
  std::vector<RateRow> rows;
  for (const auto& replay : replays) {
    const ReplayInput& input = replay->input();
    const ReplayResult& result = replay->result();
    RateRow row{.trace = input.name, .path = input.path, .category = input.category,
                .status = status_text(result.status), .scheme = ""};
    row.frames = result.frames_in_trace;
    row.frames_wanted = result.frames_wanted;
    row.frames_captured = result.frames_captured;
    row.seconds = result.seconds;
    append_rows(row, result.run, rows);
  }
  return rows;
}

std::vector<RateRow> rate_rows(const RunRecord& run, const std::string& name, const std::string& category) {
  RateRow row{.trace = name, .path = run.path, .category = category,
              .status = run.state == "finished" ? "done" : run.state, .scheme = ""};
  row.frames = row.frames_wanted = run.counts.seen - run.counts.skipped;
  row.frames_captured = run.counts.captured;
  std::vector<RateRow> rows;
  append_rows(row, run, rows);
  return rows;
}

std::vector<CategoryMean> category_means(const std::vector<RateRow>& rows) {
  std::vector<std::string> categories, schemes;
  for (const RateRow& row : rows) {
    if (!is_measured(row)) continue;
    if (!row.category.empty()) append_once(categories, row.category);
    append_once(schemes, row.scheme);
  }
  categories.emplace_back();
  std::vector<CategoryMean> means;
  for (const std::string& category : categories)
    for (const std::string& scheme : schemes) {
      uint64_t traces = 0;
      double inverse = 0, inverse_payload = 0;
      for (const RateRow& row : rows) {
        if (!is_measured(row) || row.scheme != scheme || (!category.empty() && row.category != category)) continue;
        ++traces;
        inverse += 1 / row.rate;
        inverse_payload += 1 / row.rate_payload;
      }
      const auto count = static_cast<double>(traces);
      if (traces > 0) means.push_back({category, scheme, traces, count / inverse, count / inverse_payload});
    }
  return means;
}

}  // namespace tilepress
