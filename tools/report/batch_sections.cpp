// Batch sections: the workloads one by one: figures, rates, coverage, hybrid share.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "page_parts.h"

namespace tilepress {
namespace {

constexpr double kPaperCoverageThreshold = 0.7;

std::string run_link(const Batch& batch, const RunSummary& run) {
  const size_t index = static_cast<size_t>(&run - batch.runs.data());
  return fmt::format("<a href=\"#run-{0}\" data-run=\"{0}\">{1}</a>", index, escape_html(run.name));
}

Section workloads_section(const Batch& batch) {
  Section out{.id = "workloads", .heading = "Workloads"};
  out.note =
      "Rates are Σ raw bits / Σ moved bits over a run's frames; metrics are means over its frames, each "
      "counting once. Warm-up "
      "frames (the first of each surface) are in neither.";
  out.table.id = "table-workloads";
  out.table.caption = "One line per run";
  out.table.text_columns = 2;
  out.table.header = {"workload", "category",     "frames",       "measured",    "unique_colors",
                      "entropy",  "pixel_change", "color_change", "fvc_coverage"};
  for (const std::string& scheme : batch.schemes) out.table.header.push_back("rate " + scheme);
  for (const RunSummary& run : batch.runs) {
    std::vector<Cell> row = {{run_link(batch, run), run.name},
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

bool in_dcp_family(const std::string& scheme) {
  return scheme_family(scheme) == "dcp";
}

/// Rates of `schemes` per workload, in the order of the batch.
Section rates_section(const Batch& batch, const std::vector<std::string>& schemes, bool with_bursts) {
  Section out;
  out.id = with_bursts ? "rates" : "rates-payload";
  out.heading = with_bursts ? "Rate per workload" : "Rate per workload, DCP schemes without bursts";
  const std::string formula =
      with_bursts ? "Σ raw / Σ (bursts · burst bits + CSB + palette bits)" : "Σ raw / Σ (payload + CSB bits)";
  out.note = formula + ". Workloads stand in the paper's order: by category, and in it by the rate of " +
             escape_html(batch.baseline) + " without bursts, smallest first.";
  Table& table = out.table;
  table.id = "table-" + out.id;
  table.caption = out.heading;
  table.header = {"workload", "category"};
  table.text_columns = 2;
  std::vector<KeyEntry> key;
  for (const std::string& scheme : schemes) {
    table.header.push_back(scheme);
    key.push_back({scheme, static_cast<size_t>(std::find(batch.schemes.begin(), batch.schemes.end(), scheme) -
                                               batch.schemes.begin())});
  }
  double low = INFINITY, high = 0;
  std::vector<ChartRow> rows;
  for (const RunSummary& run : batch.runs) {
    ChartRow row{run.name, batch.categories.size() > 1 ? category_label(run.category) : "", {}};
    std::vector<Cell> cells = {text_cell(run.name), text_cell(run.category)};
    for (const KeyEntry& entry : key) {
      const double rate = with_bursts ? run.rate(entry.label) : run.rate_payload(entry.label);
      cells.push_back(number_cell(rate));
      if (std::isnan(rate)) continue;
      low = std::min(low, rate);
      high = std::max(high, rate);
      row.marks.push_back(
          {rate, entry.color_index, fmt::format("{}, {}: {}", run.name, entry.label, shown_number(rate))});
    }
    rows.push_back(std::move(row));
    table.rows.push_back(std::move(cells));
  }
  if (high > 0)
    out.chart = chart_key(key) +
                row_chart(rows, AxisScale::for_rates(low, high), RowShape::kDots, "rate (raw / moved bits)",
                          fmt::format("{}: {} workloads, rates from {} to {}. The table has all figures.",
                                      out.heading, rows.size(), shown_number(low), shown_number(high)));
  return out;
}

Section coverage_section(const Batch& batch) {
  Section out{.id = "coverage", .heading = "Rate against FVC coverage"};
  out.note =
      "A point per workload: mean FVC coverage of its frames and its rate. The dashed line is the paper's "
      "coverage threshold of 0.7.";
  Table& table = out.table;
  table.id = "table-coverage";
  table.caption = "FVC coverage and rates";
  table.header = {"workload", "fvc_coverage"};
  std::string chosen = batch.baseline;
  for (const std::string& scheme : batch.schemes)
    if (scheme == "vdcp") chosen = scheme;
  std::string pick = "<label class=\"pick\">Scheme <select data-swap=\"coverage\">";
  std::string charts;
  for (size_t i = 0; i < batch.schemes.size(); ++i) {
    const std::string& scheme = batch.schemes[i];
    table.header.push_back("rate " + scheme);
    std::vector<ScatterPoint> points;
    double low = INFINITY, high = 0;
    for (const RunSummary& run : batch.runs) {
      const double rate = run.rate(scheme);
      if (std::isnan(rate)) continue;
      low = std::min(low, rate);
      high = std::max(high, rate);
      points.push_back({run.means.fvc_coverage, rate, i,
                        fmt::format("{}: coverage {}, rate {}", run.name,
                                    shown_number(run.means.fvc_coverage), shown_number(rate))});
    }
    pick += fmt::format("<option{}>{}</option>", scheme == chosen ? " selected" : "", escape_html(scheme));
    charts += fmt::format("<div data-swap-of=\"coverage\" data-swap-key=\"{}\"{}>", escape_html(scheme),
                          scheme == chosen ? "" : " hidden");
    if (points.empty())
      charts += "<p>No workload has a rate of this scheme.</p>";
    else
      charts += scatter_chart(
          points, AxisScale::linear(1, 0.1), AxisScale::for_rates(low, high),
          "FVC coverage (share of pixels)", "rate of " + scheme, kPaperCoverageThreshold,
          fmt::format("Rate of {} against FVC coverage, {} workloads. The table has all figures.", scheme,
                      points.size()));
    charts += "</div>\n";
  }
  for (const RunSummary& run : batch.runs) {
    std::vector<Cell> cells = {text_cell(run.name), number_cell(run.means.fvc_coverage)};
    for (const std::string& scheme : batch.schemes) cells.push_back(number_cell(run.rate(scheme)));
    table.rows.push_back(std::move(cells));
  }
  out.chart = pick + "</select></label>\n" + charts;
  return out;
}

/// Colours of the two halves: those of vdcp and ras where the batch has them.
size_t color_of(const Batch& batch, const std::string& scheme, size_t otherwise) {
  const auto found = std::find(batch.schemes.begin(), batch.schemes.end(), scheme);
  return found == batch.schemes.end() ? otherwise : static_cast<size_t>(found - batch.schemes.begin());
}

Section hybrid_section(const Batch& batch) {
  Section out{.id = "hybrid", .heading = "Hybrid share: VDCP and RAS blocks"};
  out.note =
      "How many blocks HDCP coded by VDCP and how many by RAS: columns vdcp_blocks and ras_blocks of "
      "schemes.csv, summed.";
  Table& table = out.table;
  table.id = "table-hybrid";
  table.caption = "Blocks of HDCP by coder";
  table.header = {"workload", "category", "vdcp_blocks", "ras_blocks", "share VDCP"};
  table.text_columns = 2;
  const size_t vdcp = color_of(batch, "vdcp", 2), ras = color_of(batch, "ras", 4);
  std::vector<ChartRow> rows;
  double sum = 0;
  for (const RunSummary& run : batch.runs) {
    const uint64_t blocks = run.vdcp_blocks + run.ras_blocks;
    if (blocks == 0) continue;
    const double share = static_cast<double>(run.vdcp_blocks) / static_cast<double>(blocks);
    sum += share;
    rows.push_back(
        {run.name,
         batch.categories.size() > 1 ? category_label(run.category) : "",
         {{share * 100, vdcp, fmt::format("{}: VDCP {}", run.name, shown_percent(share))},
          {(1 - share) * 100, ras, fmt::format("{}: RAS {}", run.name, shown_percent(1 - share))}}});
    table.rows.push_back({text_cell(run.name), text_cell(run.category), count_cell(run.vdcp_blocks),
                          count_cell(run.ras_blocks), percent_cell(share)});
  }
  if (rows.empty()) {
    out.heading.clear();
    return out;
  }
  const double mean = sum / static_cast<double>(rows.size());
  out.note += fmt::format(
      " Mean share of VDCP over the workloads: {} (the paper: on average equal numbers of blocks).",
      shown_percent(mean));
  out.chart = chart_key({{"coded by VDCP", vdcp}, {"coded by RAS", ras}}) +
              row_chart(rows, AxisScale::linear(100, 20), RowShape::kStack, "share of blocks in percent",
                        fmt::format("Share of blocks coded by VDCP, {} workloads, mean {}.", rows.size(),
                                    shown_percent(mean)));
  return out;
}

}  // namespace

std::vector<Section> batch_sections(const Batch& batch) {
  std::vector<std::string> family;
  for (const std::string& scheme : batch.schemes)
    if (in_dcp_family(scheme)) family.push_back(scheme);
  std::vector<Section> out = {workloads_section(batch), rates_section(batch, batch.schemes, true)};
  if (!family.empty()) out.push_back(rates_section(batch, family, false));
  out.push_back(coverage_section(batch));
  out.push_back(hybrid_section(batch));
  std::erase_if(out, [](const Section& section) { return section.heading.empty(); });
  return out;
}

}  // namespace tilepress
