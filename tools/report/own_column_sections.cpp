// Own column sections: CSV columns that a scheme adds to the common ones.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "published_means.h"
#include "scheme_names.h"
#include "sections.h"

namespace tilepress {
namespace {

/// The scheme that coded the blocks of a column "<scheme>_blocks"; null for other columns.
const SchemeInfo* coder_of(std::string_view column) {
  constexpr std::string_view kEnding = "_blocks";
  if (!column.ends_with(kEnding)) return nullptr;
  return find_scheme(column.substr(0, column.size() - kEnding.size()));
}

uint64_t sum_of_columns(const SchemeInfo& info, const OwnCounts& own) {
  return std::accumulate(own.begin(), own.begin() + static_cast<ptrdiff_t>(info.columns.size()), uint64_t{0});
}

/// The counts of the run's first configuration of the scheme; null without any.
const OwnCounts* counts_of(const RunSummary& run, const SchemeInfo& info) {
  for (size_t i = 0; i < run.schemes.size(); ++i) {
    const OwnCounts& own = run.totals[i].own;
    if (scheme_info(run.schemes[i]) == &info && sum_of_columns(info, own) > 0) return &own;
  }
  return nullptr;
}

/// Shares of the columns as marks that stand end to end.
std::vector<ChartMark> share_marks(const Batch& batch, const SchemeInfo& info, const RunSummary& run,
                                   const std::vector<double>& shares) {
  std::vector<ChartMark> marks;
  for (size_t i = 0; i < shares.size(); ++i) {
    const SchemeInfo& coder = *coder_of(info.columns[i]);
    marks.push_back({shares[i] * 100, batch.color_of(coder.name, 2 + 2 * i),
                     fmt::format("{}: {} {}", run.name, coder.label, shown_percent(shares[i]))});
  }
  return marks;
}

Section own_columns_section(const Batch& batch, const SchemeInfo& info) {
  const std::string names = fmt::format("{}", fmt::join(info.columns, " and "));
  // Blocks by coder are shares of a whole; other counts have no common unit.
  const bool by_coder = std::all_of(info.columns.begin(), info.columns.end(), coder_of);
  Section out{.heading =
                  fmt::format("{}: {}", info.label, by_coder ? "blocks by coder" : "columns of its own")};
  out.note = escape_html(fmt::format("Sums of the columns {} of schemes.csv.", names));
  out.table = {
      .name = info.family, .caption = out.heading, .header = {"workload", "category"}, .text_columns = 2};
  for (const char* column : info.columns) out.table.header.push_back(column);
  std::vector<KeyEntry> key;
  for (size_t i = 0; by_coder && i < info.columns.size(); ++i) {
    const SchemeInfo& coder = *coder_of(info.columns[i]);
    out.table.header.push_back(fmt::format("share {}", coder.label));
    key.push_back({fmt::format("coded by {}", coder.label), batch.color_of(coder.name, 2 + 2 * i)});
  }
  std::vector<ChartRow> rows;
  double first_share = 0;
  for (const RunSummary& run : batch.runs) {
    const OwnCounts* own = counts_of(run, info);
    if (own == nullptr) continue;
    std::vector<Cell> cells = {text_cell(run.name), text_cell(run.category)};
    const auto sum = static_cast<double>(sum_of_columns(info, *own));
    std::vector<double> shares;
    for (size_t i = 0; i < info.columns.size(); ++i) {
      cells.push_back(count_cell((*own)[i]));
      shares.push_back(static_cast<double>((*own)[i]) / sum);
    }
    if (by_coder) {
      for (const double share : shares) cells.push_back(percent_cell(share));
      rows.push_back({run.name, batch.group_of(run), share_marks(batch, info, run, shares)});
      first_share += shares.front();
    }
    out.table.rows.push_back(std::move(cells));
  }
  if (rows.empty()) return out;
  const std::string mean = shown_percent(first_share / static_cast<double>(rows.size()));
  out.note += fmt::format(" Mean share of {} over the workloads: {}.",
                          escape_html(coder_of(info.columns[0])->label), mean);
  if (info.name == kPublishedShare.scheme) out.note += fmt::format(" {}", kPublishedShare.text);
  out.chart =
      chart_key(key) + row_chart(rows, AxisScale::linear(100, 20), RowShape::kStack,
                                 "share of blocks in percent", out.heading + ". The table has all figures.");
  return out;
}

}  // namespace

std::vector<Section> own_column_sections(const Batch& batch) {
  std::vector<Section> out;
  for (const SchemeInfo& info : scheme_registry()) {
    if (info.columns.empty()) continue;
    Section section = own_columns_section(batch, info);
    if (!section.table.rows.empty()) out.push_back(std::move(section));
  }
  return out;
}

}  // namespace tilepress
