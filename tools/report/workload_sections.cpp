// Workload sections: the figures and rates of each workload.
#include <fmt/format.h>

#include <cmath>

#include "counted.h"
#include "scheme_names.h"
#include "sections.h"

namespace tilepress {

static std::string run_link(const Batch& batch, const RunSummary& run) {
  const size_t index = static_cast<size_t>(&run - batch.runs.data());
  return fmt::format("<a href=\"#run-{0}\" data-run=\"{0}\">{1}</a>", index, escape_html(run.name));
}

Section workloads_section(const Batch& batch) {
  Section out{.heading = "Workloads"};
  out.note =
      "Rates are Σ raw bits / Σ moved bits over the frames of a run. Metrics are means over its frames. "
      "Warm-up frames (the first frame of each surface) are in neither.";
  out.table = {.name = "workloads",
               .caption = "One row per run",
               .header = {"workload", "category", "frames", "measured", "unique_colors", "entropy",
                          "pixel_change", "color_change", "fvc_coverage"},
               .text_columns = 2};
  for (const std::string& scheme : batch.schemes) out.table.header.push_back("rate " + scheme);
  for (const RunSummary& run : batch.runs) {
    std::vector<Cell> row = {{run.name, run.name, run_link(batch, run)},
                             text_cell(run.category),
                             count_cell(run.frames),
                             count_cell(run.measured),
                             number_cell(run.means.unique_colors),
                             number_cell(run.means.entropy),
                             percent_cell(run.means.pixel_change),
                             percent_cell(run.means.color_change),
                             percent_cell(run.means.fvc_coverage)};
    for (const std::string& scheme : batch.schemes) row.push_back(number_cell(run.rate(scheme)));
    out.table.rows.push_back(std::move(row));
  }
  return out;
}

Section rates_section(const Batch& batch, const std::vector<std::string>& schemes, bool with_bursts) {
  Section out;
  out.heading = with_bursts ? "Rate per workload" : "Rate per workload, DCP schemes without bursts";
  const std::string formula =
      with_bursts ? "Σ raw / Σ (bursts · burst bits + CSB + palette bits)" : "Σ raw / Σ (payload + CSB bits)";
  out.note = formula +
             ". Workloads have the paper's order: by category, and within a category by the rate of " +
             escape_html(batch.baseline) + " without bursts, smallest first.";
  Table& table = out.table;
  table = {.name = with_bursts ? "rates" : "rates-payload",
           .caption = out.heading,
           .header = {"workload", "category"},
           .text_columns = 2};
  std::vector<KeyEntry> key;
  for (const std::string& scheme : schemes) {
    table.header.push_back(scheme);
    key.push_back({scheme, batch.color_of(scheme), name_of(scheme_group(scheme))});
  }
  ValueRange range;
  std::vector<ChartRow> rows;
  for (const RunSummary& run : batch.runs) {
    ChartRow row{run.name, batch.group_of(run), {}};
    std::vector<Cell> cells = {text_cell(run.name), text_cell(run.category)};
    for (const KeyEntry& entry : key) {
      const double rate = with_bursts ? run.rate(entry.label) : run.rate_payload(entry.label);
      cells.push_back(number_cell(rate));
      if (std::isnan(rate)) continue;
      range.add(rate);
      row.marks.push_back(
          {rate, entry.color_index, fmt::format("{}, {}: {}", run.name, entry.label, shown_number(rate))});
    }
    rows.push_back(std::move(row));
    table.rows.push_back(std::move(cells));
  }
  if (range.high > 0)
    out.chart =
        chart_key(key) + row_chart(rows, AxisScale::for_rates(range.low, range.high), RowShape::kDots,
                                   "rate (raw / moved bits)",
                                   fmt::format("{}: {}, rates from {} to {}. The table has all figures.",
                                               out.heading, counted(rows.size(), "workload"),
                                               shown_number(range.low), shown_number(range.high)));
  return out;
}

}  // namespace tilepress
