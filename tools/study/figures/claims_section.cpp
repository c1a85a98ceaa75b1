// Claims section: what the paper states and what the study measures, on common axes.
#include <fmt/format.h>

#include <cmath>

#include "study/figures/page_figures.h"
#include "study/figures/study_page.h"

namespace tilepress {
namespace {

constexpr double kPercent = 100;

/// Rows of the claims with one unit; the values times `scale`.
std::string unit_chart(const std::vector<Claim>& claims, ClaimUnit unit, double scale, const char* axis_text,
                       const char* described) {
  std::vector<ChartRow> rows;
  ValueRange range;
  for (const Claim& claim : claims) {
    if (claim.rule.unit != unit || !std::isfinite(claim.ours)) continue;
    // Gains follow from rates that the chart has.
    if (claim.rule.source == ClaimSource::kGain) continue;
    const std::string category = claim.rule.category;
    const std::string label = category.empty() ? claim.rule.text : category + ": " + claim.rule.text;
    ChartRow row{label, claim.rule.section, {}};
    for (const auto& [value, color, owner] : {std::tuple(claim.rule.published, kPaperColor, "paper"),
                                              std::tuple(claim.ours, kOurColor, "this study")}) {
      range.add(value * scale);
      row.marks.push_back(
          {value * scale, color, fmt::format("{}, {}: {}", label, owner, claim_value(value, unit))});
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  return row_chart(rows, AxisScale::for_rates(0, range.high), RowShape::kDots, axis_text, described);
}

}  // namespace

Section claims_section(const std::vector<Claim>& claims) {
  Section out{.heading = "What the paper states, and what this study measures",
              .table = claims_table(claims)};
  out.note = escape_html(out.table.note);
  const std::string rates = unit_chart(claims, ClaimUnit::kRate, 1, "compression rate",
                                       "Rates of the paper and of this study. The table has all figures.");
  const std::string shares = unit_chart(claims, ClaimUnit::kShare, kPercent, "percent",
                                        "Shares of the paper and of this study. The table has all figures.");
  if (rates.empty() && shares.empty()) return out;
  out.chart = chart_key({{"paper", kPaperColor}, {"this study", kOurColor}}) +
              "<div class=\"wide\"><h3>Rates</h3>\n" + rates + "<h3>Shares</h3>\n" + shares + "</div>\n";
  return out;
}

}  // namespace tilepress
