// Claims: evaluates the rules on a study.
#include "study/figures/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "counted.h"
#include "study/figures/document_table.h"
#include "study/figures/figure_makers.h"
#include "study/figures/hybrid_blocks.h"
#include "tilepress/cost_model.h"
#include "tilepress/csv_table.h"

namespace tilepress {
namespace {

constexpr double kCoverageThreshold = 0.7;

/// The rule's category as the study spells it.
std::string spelled(const StudyData& data, const ClaimRule& rule) {
  return data.spelled_category(rule.category);
}

/// The values of the rule, one per workload of the category that has one.
std::vector<double> workload_values_of(const StudyData& data, const ClaimRule& rule) {
  std::vector<double> values;
  for (const size_t row : data.workloads_of(spelled(data, rule))) {
    const std::string& workload = data.workloads.text(row, "workload");
    double value = data.result(workload, rule.configuration, rule.column);
    if (rule.source == ClaimSource::kWorkloadMean) value = data.workloads.number(row, rule.column);
    if (rule.source == ClaimSource::kHybridShare) {
      const HybridBlocks blocks = hybrid_blocks(data, workload, rule.configuration);
      value = blocks.vdcp_only() / (blocks.vdcp_only() + blocks.ras_only());
    }
    const bool covered = !(data.workloads.number(row, "fvc_coverage") < kCoverageThreshold);
    if (std::isfinite(value) && (covered || rule.source != ClaimSource::kLowestCovered))
      values.push_back(value);
  }
  return values;
}

/// "2 of 3 workloads are shorter than the period." Empty if all are longer or the claim is about no period.
std::string short_workloads(const StudyData& data, const ClaimRule& rule) {
  constexpr std::string_view kPeriod = "period=";
  const std::string_view configuration = rule.configuration;
  const size_t at = configuration.find(kPeriod);
  double period = 0;
  if (at == std::string_view::npos || !read_csv(configuration.substr(at + kPeriod.size()), period)) return "";
  const std::vector<size_t> rows = data.workloads_of(spelled(data, rule));
  const auto is_short = [&](size_t row) { return data.workloads.number(row, "frames") <= period; };
  const auto count = std::count_if(rows.begin(), rows.end(), is_short);
  if (count == 0) return "";
  return fmt::format("{} of {} have no more frames than the period.", count,
                     counted(rows.size(), "workload"));
}

Claim claim_on_means(const StudyData& data, const ClaimRule& rule) {
  const double mean = data.mean(spelled(data, rule), rule.configuration, rule.column);
  const double base = data.mean(spelled(data, rule), rule.base, rule.column);
  const double workloads = data.mean(spelled(data, rule), rule.configuration, "workloads");
  Claim claim{rule, mean, std::isnan(workloads) ? 0 : static_cast<size_t>(workloads)};
  if (rule.source == ClaimSource::kRelative) claim.ours = mean / base;
  if (rule.source == ClaimSource::kRelative) claim.reason = short_workloads(data, rule);
  if (rule.source == ClaimSource::kGain) claim.ours = mean / base - 1;
  if (rule.source == ClaimSource::kSaving) claim.ours = energy_saving(mean);
  return claim;
}

Claim claim_on_workloads(const StudyData& data, const ClaimRule& rule) {
  const std::vector<double> values = workload_values_of(data, rule);
  if (values.empty()) return {rule, NAN, 0};
  Claim claim{rule, std::accumulate(values.begin(), values.end(), 0.0) / double(values.size()),
              values.size()};
  if (rule.source == ClaimSource::kLowestCovered) claim.ours = std::ranges::min(values);
  if (rule.source == ClaimSource::kLargest) claim.ours = std::ranges::max(values);
  return claim;
}

/// The workload with the median entropy of its category stands in: neither its plainest nor its richest.
Claim claim_on_stand_in(const StudyData& data, const ClaimRule& rule) {
  std::vector<size_t> rows = data.workloads_of(spelled(data, rule));
  const auto entropy = [&](size_t row) { return data.workloads.number(row, "entropy"); };
  std::erase_if(rows, [&](size_t row) { return std::isnan(entropy(row)); });
  if (rows.empty()) return {rule, NAN, 0};
  std::ranges::stable_sort(rows, {}, entropy);
  const size_t row = rows[(rows.size() - 1) / 2];
  return {rule, data.workloads.number(row, rule.column), 1, data.workloads.text(row, "workload")};
}

Claim make_claim(const StudyData& data, const ClaimRule& rule) {
  switch (rule.source) {
    case ClaimSource::kCostModel:
      return {rule, rule.cost(), 0};
    case ClaimSource::kStandIn:
      return claim_on_stand_in(data, rule);
    case ClaimSource::kWorkloadMean:
    case ClaimSource::kLargest:
    case ClaimSource::kLowestCovered:
    case ClaimSource::kHybridShare:
      return claim_on_workloads(data, rule);
    default:
      return claim_on_means(data, rule);
  }
}

struct UnitText {
  const char* name;    ///< in claims.csv
  const char* suffix;  ///< after a value
};
constexpr UnitText kUnits[] = {{"rate", ""},    {"share", " %"}, {"bits per pixel", " bit"}, {"bytes", " B"},
                               {"mm2", " mm²"}, {"mW", " mW"},   {"pJ per byte", " pJ"}};

std::string deviation_text(double deviation) {
  constexpr double kRoundsToZero = 0.0005;
  if (!std::isfinite(deviation)) return "–";
  if (std::abs(deviation) < kRoundsToZero) return "0.0 %";
  return fmt::format("{:+.1f} %", deviation * 100);
}

std::string remark_of(const Claim& claim) {
  std::string out = claim.stands_for.empty() ? "" : "Here: " + claim.stands_for + ".";
  for (const std::string& text : {std::string(claim.rule.note), claim.reason})
    if (!text.empty()) out += (out.empty() ? "" : " ") + text;
  return out;
}

}  // namespace

std::vector<Claim> make_claims(const StudyData& data) {
  std::vector<Claim> out;
  for (const ClaimRule& rule : claim_rules()) out.push_back(make_claim(data, rule));
  return out;
}

std::string claim_value(double value, ClaimUnit unit) {
  if (std::isnan(value)) return "–";
  const char* suffix = kUnits[static_cast<size_t>(unit)].suffix;
  if (unit == ClaimUnit::kShare) return fmt::format("{:.1f}{}", value * 100, suffix);
  if (unit == ClaimUnit::kSquareMillimetres) return fmt::format("{:.6f}{}", value, suffix);
  if (unit == ClaimUnit::kBytes) return fmt::format("{:.0f}{}", value, suffix);
  return fmt::format("{:.2f}{}", value, suffix);
}

Table claims_table(const std::vector<Claim>& claims) {
  Table table{.name = "claims",
              .caption = "What the paper states, and what this study measures",
              .header = {"claim", "category", "paper", "this study", "deviation", "workloads", "remark"},
              .text_columns = 2,
              .wrapped = {0, 6},
              .note =
                  "deviation = this study / paper − 1, for a gain that of 1 + gain. The paper has 92 UI, 20 "
                  "2D and 12 3D "
                  "applications for Android. A claim about one application stands beside the workload of its "
                  "category with "
                  "the median entropy."};
  for (const Claim& claim : claims) {
    const auto value = [&](double number) {
      return Cell{claim_value(number, claim.rule.unit), number_cell_text(number)};
    };
    table.rows.push_back({text_cell(claim.rule.text),
                          text_cell(claim.rule.category),
                          value(claim.rule.published),
                          value(claim.ours),
                          {deviation_text(claim.deviation()), number_cell_text(claim.deviation())},
                          text_cell(claim.workloads > 0 ? std::to_string(claim.workloads) : ""),
                          text_cell(remark_of(claim))});
  }
  return table;
}

std::string claims_csv(const std::vector<Claim>& claims) {
  Table table{.header = {"id", "section", "claim", "category", "configuration", "unit", "published", "ours",
                         "deviation", "workloads", "stands_for", "note"}};
  for (const Claim& claim : claims) {
    const ClaimRule& rule = claim.rule;
    table.rows.push_back({text_cell(rule.id), text_cell(rule.section), text_cell(rule.text),
                          text_cell(rule.category), text_cell(rule.configuration),
                          text_cell(kUnits[static_cast<size_t>(rule.unit)].name), exact_cell(rule.published),
                          exact_cell(claim.ours), exact_cell(claim.deviation()), count_cell(claim.workloads),
                          text_cell(claim.stands_for), text_cell(remark_of(claim))});
  }
  return table_csv(table);
}

}  // namespace tilepress
