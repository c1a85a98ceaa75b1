// Figure makers: what the kinds share.
#include "study/figures/figure_makers.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>

#include "report/run_summary.h"
#include "tilepress/csv_table.h"

namespace tilepress {

std::string number_cell_text(double value) {
  return std::isfinite(value) ? csv_number(value) : "";
}

static bool shows_category(const FigureSpec& spec, const std::string& category) {
  return spec.categories.empty() || std::ranges::find(spec.categories, category) != spec.categories.end();
}

std::vector<size_t> drawn_workloads(const StudyData& data, const FigureSpec& spec) {
  std::vector<size_t> rows = data.ordered_workloads();
  std::erase_if(rows, [&](size_t row) {
    const std::string& workload = data.workloads.text(row, "workload");
    const auto matches = [&](const std::string& pattern) {
      return fnmatch(pattern.c_str(), workload.c_str(), 0) == 0;
    };
    return !shows_category(spec, data.workloads.text(row, "category")) ||
           (!spec.workloads.empty() && std::ranges::none_of(spec.workloads, matches));
  });
  return rows;
}

std::vector<std::string> drawn_categories(const StudyData& data, const FigureSpec& spec) {
  std::vector<std::string> out;
  for (const std::string& category : data.categories()) {
    const bool published = std::ranges::count(spec.published, category, &PublishedPoint::category) > 0;
    const bool wanted = category != kAllCategories || published || !spec.categories.empty();
    if (wanted && shows_category(spec, category)) out.push_back(category);
  }
  if (out.empty()) out.emplace_back(kAllCategories);
  return out;
}

std::string rate_label(const FigureSpec& spec) {
  if (!spec.normalized_to.empty()) return "rate relative to " + spec.normalized_to;
  return spec.value == "rate_payload" ? "rate without bursts" : "compression rate";
}

void add_bound_columns(const StudyData& data, const FigureSpec& spec, StudyTable& table) {
  if (!spec.normalized_to.empty()) return;
  const bool by_workload = table.has("workload");
  for (const std::string& name : data.bound_names()) {
    for (size_t row = 0; row < table.rows.size(); ++row) {
      const double value = by_workload ? data.bound(table.text(row, "workload"), name, spec.value)
                                       : data.bound_mean(table.text(row, "category"), name, spec.value + "_hmean");
      table.rows[row].push_back(number_cell_text(value));
    }
    table.header.push_back(name);
  }
}

ValueSpread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {NAN, NAN, NAN, 0};
  return {std::ranges::min(values), median(values), std::ranges::max(values), values.size()};
}

std::vector<double> workload_values(const StudyData& data, const std::string& category,
                                    const std::function<double(const std::string&)>& value_of) {
  std::vector<double> out;
  for (const size_t row : data.workloads_of(category)) {
    const double value = value_of(data.workloads.text(row, "workload"));
    if (std::isfinite(value)) out.push_back(value);
  }
  return out;
}

}  // namespace tilepress
