// Result tables: each column is a line of a table.
#include "study_tables.h"

#include <algorithm>
#include <functional>

#include "report/run_summary.h"
#include "study/bounds/bound_coders.h"
#include "study/configuration.h"
#include "tilepress/cost_model.h"
#include "tilepress/csv_table.h"
#include "tilepress/dram_presets.h"
#include "tilepress/scheme.h"

namespace tilepress {
namespace {

template <class T>
void append_optional(std::string& out, const std::optional<T>& value) {
  if (value) append_csv(out, *value);
}

/// DRAM and DCP's structures; the paper has no figures for the logic of other schemes.
std::optional<double> energy_nj(const SchemeSpec& spec, const SchemeStatistics& total) {
  if (!find_scheme(spec.name)->has_dcp_structures) return std::nullopt;
  const CostConstants constants;
  return (static_cast<double>(total.moved_bits()) / 8 * constants.dram_pj_per_byte +
          static_cast<double>(total.raw_bits) / 8 * constants.structures_pj_per_byte) /
         1000;
}

namespace sums_csv {
using Row = ResultSums;
constexpr CsvColumn<Row> kColumns[] = {
    csv_column<Row, &Row::frames>("frames"),
    TILEPRESS_CSV_FIGURE("blocks", row.total.blocks),
    TILEPRESS_CSV_FIGURE("raw_bits", row.total.raw_bits),
    TILEPRESS_CSV_FIGURE("payload_bits", row.total.payload_bits),
    TILEPRESS_CSV_FIGURE("bursts", row.total.bursts),
    TILEPRESS_CSV_FIGURE("burst_bits", row.total.burst_bits),
    TILEPRESS_CSV_FIGURE("csb_bits", row.total.csb_bits),
    TILEPRESS_CSV_FIGURE("palette_bits", row.total.palette_bits),
    TILEPRESS_CSV_FIGURE("extra_bits", row.total.extra_bits),
    TILEPRESS_CSV_FIGURE("moved_bits", row.total.moved_bits()),
    TILEPRESS_CSV_FIGURE("rate", row.total.rate()),
    TILEPRESS_CSV_FIGURE("rate_payload", row.total.rate_payload()),
    TILEPRESS_CSV_FIGURE("rate_with_extra", row.total.rate_with_extra()),
};
}  // namespace sums_csv

/// The values of one configuration over the workloads of a category.
struct ConfigurationValues {
  std::vector<double> rates, rates_payload;
  MeanOverFrames coverage, relative_coverage;  ///< over workloads

  void add(const ResultSums& sums) {
    rates.push_back(sums.total.rate());
    rates_payload.push_back(sums.total.rate_payload());
    if (const auto mean = sums.fvc_coverage.mean()) coverage.add(*mean);
    if (const auto mean = sums.fvc_relative_coverage.mean()) relative_coverage.add(*mean);
  }
};

namespace means_table {
using Row = ConfigurationValues;
constexpr CsvColumn<Row> kColumns[] = {
    TILEPRESS_CSV_FIGURE("workloads", row.rates.size()),
    TILEPRESS_CSV_FIGURE("rate_hmean", harmonic_mean(row.rates)),
    TILEPRESS_CSV_FIGURE("rate_payload_hmean", harmonic_mean(row.rates_payload)),
    TILEPRESS_CSV_FIGURE("rate_min", *std::ranges::min_element(row.rates)),
    TILEPRESS_CSV_FIGURE("rate_median", median(row.rates)),
    TILEPRESS_CSV_FIGURE("rate_max", *std::ranges::max_element(row.rates)),
    TILEPRESS_CSV_FIGURE("rate_payload_min", *std::ranges::min_element(row.rates_payload)),
    TILEPRESS_CSV_FIGURE("rate_payload_median", median(row.rates_payload)),
    TILEPRESS_CSV_FIGURE("rate_payload_max", *std::ranges::max_element(row.rates_payload)),
};
constexpr CsvColumn<Row> kCoverageColumns[] = {
    {"fvc_coverage_mean",
     [](const Row& row, std::string& out) { append_optional(out, row.coverage.mean()); }},
    {"fvc_relative_coverage_mean",
     [](const Row& row, std::string& out) { append_optional(out, row.relative_coverage.mean()); }},
};
}  // namespace means_table

/// Over the workloads that have result i in `list_of(results)`. Empty `category`: all workloads.
template <class ListOf>
ConfigurationValues values_of(const StudyPlan& plan, const std::vector<WorkloadResults>& results,
                              const std::string& category, const ListOf& list_of, size_t i) {
  ConfigurationValues values;
  for (size_t workload = 0; workload < results.size(); ++workload) {
    const std::vector<std::optional<ResultSums>>& sums = std::invoke(list_of, results[workload]);
    if (i >= sums.size() || !sums[i] || sums[i]->frames == 0) continue;
    if (category.empty() || plan.workloads[workload].category == category) values.add(*sums[i]);
  }
  return values;
}

/// Calls append(category, cell of the category) for each category of the study, and for all workloads: "".
template <class Append>
void for_each_category(const StudyPlan& plan, const Append& append) {
  for (const StudyCategory& category : plan.study.categories)
    append(category.name, csv_field(category.name) + ",");
  append("", "all,");
}

/// The names of the presets with this burst.
std::string presets_with(uint32_t burst_bits) {
  std::string out;
  for (const DramPreset& preset : kDramPresets)
    if (preset.burst_bits == burst_bits) out.append(out.empty() ? "" : " ").append(preset.name);
  return out;
}

}  // namespace

std::string results_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = "workload,category," + configuration_header() + ",";
  append_csv_names(sums_csv::kColumns, out);
  out += ",fvc_coverage,fvc_relative_coverage";
  for (const std::string_view name : own_column_names()) out.append(",").append(name);
  out += ",energy_nj\n";
  for (size_t workload = 0; workload < results.size(); ++workload)
    for (size_t i = 0; i < plan.study.configurations.size(); ++i) {
      const SchemeSpec& spec = plan.study.configurations[i];
      const auto& sums = results[workload].sums[i];
      if (!sums || sums->frames == 0) continue;
      append_configuration(spec, out += subject_cells(plan.workloads[workload]));
      append_csv_fields(sums_csv::kColumns, *sums, out += ',');
      append_optional(out += ',', sums->fvc_coverage.mean());
      append_optional(out += ',', sums->fvc_relative_coverage.mean());
      for (const auto& count : sums->own) append_optional(out += ',', count);
      append_optional(out += ',', energy_nj(spec, sums->total));
      out += '\n';
    }
  return out;
}

std::string means_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = "category," + configuration_header() + ",";
  append_csv_names(means_table::kColumns, out);
  out += "," + csv_header(means_table::kCoverageColumns);
  for_each_category(plan, [&](const std::string& category, const std::string& cell) {
    for (size_t i = 0; i < plan.study.configurations.size(); ++i) {
      const ConfigurationValues values = values_of(plan, results, category, &WorkloadResults::sums, i);
      if (values.rates.empty()) continue;
      append_configuration(plan.study.configurations[i], out += cell);
      append_csv_fields(means_table::kColumns, values, out += ',');
      append_csv_row(means_table::kCoverageColumns, values, out += ',');
    }
  });
  return out;
}

std::string bounds_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = "workload,category,bound," + csv_header(sums_csv::kColumns);
  for (size_t workload = 0; workload < results.size(); ++workload)
    for (size_t i = 0; i < results[workload].bounds.size(); ++i) {
      const auto& sums = results[workload].bounds[i];
      if (!sums || sums->frames == 0) continue;
      append_csv(out += subject_cells(plan.workloads[workload]), bound_names()[i]);
      append_csv_row(sums_csv::kColumns, *sums, out += ',');
    }
  return out;
}

std::string bound_means_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  std::string out = "category,bound," + csv_header(means_table::kColumns);
  for_each_category(plan, [&](const std::string& category, const std::string& cell) {
    for (size_t i = 0; i < bound_names().size(); ++i) {
      const ConfigurationValues values = values_of(plan, results, category, &WorkloadResults::bounds, i);
      if (values.rates.empty()) continue;
      append_csv(out += cell, bound_names()[i]);
      append_csv_row(means_table::kColumns, values, out += ',');
    }
  });
  return out;
}

std::string sensitivity_csv(const StudyPlan& plan, const std::vector<WorkloadResults>& results) {
  static const std::vector<std::optional<ResultSums>> kNone;
  std::string out = "category," + configuration_header() + ",burst_bits,dram," + csv_header(means_table::kColumns);
  const auto append = [&](const std::string& category, const std::string& cell, size_t i, uint32_t burst) {
    const auto at_burst = [&](const WorkloadResults& of) -> const std::vector<std::optional<ResultSums>>& {
      const auto further = of.at_bursts.find(burst);
      if (further != of.at_bursts.end()) return further->second;
      const bool is_main = i < of.sums.size() && of.sums[i] && of.sums[i]->total.burst_bits == burst;
      return is_main ? of.sums : kNone;
    };
    const ConfigurationValues values = values_of(plan, results, category, at_burst, i);
    if (values.rates.empty()) return;
    append_configuration(plan.study.configurations[i], out += cell);
    append_csv(out += ',', burst);
    append_csv(out += ',', presets_with(burst));
    append_csv_row(means_table::kColumns, values, out += ',');
  };
  for_each_category(plan, [&](const std::string& category, const std::string& cell) {
    for (size_t i = 0; i < plan.study.configurations.size(); ++i)
      for (const uint32_t burst : plan.study.bursts) append(category, cell, i, burst);
  });
  return out;
}

}  // namespace tilepress
