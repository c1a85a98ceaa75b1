// Coverage section: rate against FVC coverage, one chart per scheme.
#include <fmt/format.h>

#include <cmath>

#include "counted.h"
#include "sections.h"

namespace tilepress {

constexpr double kPaperCoverageThreshold = 0.7;

static std::string scheme_chart(const Batch& batch, size_t index) {
  const std::string& scheme = batch.schemes[index];
  std::vector<ScatterPoint> points;
  ValueRange range;
  for (const RunSummary& run : batch.runs) {
    const double rate = run.rate(scheme), coverage = run.means.fvc_coverage;
    if (std::isnan(rate)) continue;
    range.add(rate);
    points.push_back(
        {coverage, rate, index,
         fmt::format("{}: coverage {}, rate {}", run.name, shown_number(coverage), shown_number(rate))});
  }
  if (points.empty()) return "<p>No workload has a rate of this scheme.</p>";
  return scatter_chart(points, AxisScale::linear(1, 0.1), AxisScale::for_rates(range.low, range.high),
                       "FVC coverage (share of pixels)", "rate of " + scheme, kPaperCoverageThreshold,
                       fmt::format("Rate of {} against FVC coverage, {}. The table has all figures.", scheme,
                                   counted(points.size(), "workload")));
}

Section coverage_section(const Batch& batch) {
  Section out{.heading = "Rate against FVC coverage"};
  out.note =
      "One point per workload: the mean FVC coverage of its frames, and its rate. The dashed line is the "
      "paper's coverage threshold of 0.7.";
  Table& table = out.table;
  table = {.name = "coverage", .caption = "FVC coverage and rates", .header = {"workload", "fvc_coverage"}};
  const std::string chosen =
      batch.color_of("vdcp", batch.schemes.size()) < batch.schemes.size() ? "vdcp" : batch.baseline;
  std::string pick = "<label class=\"pick\">Scheme <select data-swap=\"coverage\">";
  std::string charts;
  for (size_t i = 0; i < batch.schemes.size(); ++i) {
    const std::string& scheme = batch.schemes[i];
    table.header.push_back("rate " + scheme);
    pick += fmt::format("<option{}>{}</option>", scheme == chosen ? " selected" : "", escape_html(scheme));
    charts += fmt::format("<div data-swap-of=\"coverage\" data-swap-key=\"{}\"{}>", escape_html(scheme),
                          scheme == chosen ? "" : " hidden");
    charts += scheme_chart(batch, i);
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

}  // namespace tilepress
