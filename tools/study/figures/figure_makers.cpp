// Figure makers: what the kinds share.
#include "study/figures/figure_makers.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tilepress/csv_table.h"

namespace tilepress {

std::string number_cell_text(double value) {
  return std::isfinite(value) ? csv_number(value) : "";
}

bool shows_workload(const FigureSpec& spec, const std::string& workload) {
  return spec.workloads.empty() ||
         std::any_of(spec.workloads.begin(), spec.workloads.end(), [&](const std::string& pattern) {
           return fnmatch(pattern.c_str(), workload.c_str(), 0) == 0;
         });
}

bool shows_category(const FigureSpec& spec, const std::string& category) {
  return spec.categories.empty() ||
         std::find(spec.categories.begin(), spec.categories.end(), category) != spec.categories.end();
}

std::vector<std::string> drawn_categories(const StudyData& data, const FigureSpec& spec) {
  std::vector<std::string> out;
  for (const std::string& category : data.categories()) {
    const bool published =
        std::any_of(spec.published.begin(), spec.published.end(),
                    [&](const PublishedPoint& point) { return point.category == category; });
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

void add_bound_columns(const StudyData& data, const FigureSpec& spec, FigureTable& table) {
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

ValueSpread spread_of(std::vector<double> values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {kNone, kNone, kNone, 0};
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  const double median = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
  return {values.front(), median, values.back(), values.size()};
}

std::vector<double> workload_values(const StudyData& data, const std::string& category,
                                    const std::function<double(const std::string&)>& value_of) {
  std::vector<double> out;
  for (const size_t row : data.ordered_workloads()) {
    if (category != kAllCategories && data.workloads.text(row, "category") != category) continue;
    const double value = value_of(data.workloads.text(row, "workload"));
    if (std::isfinite(value)) out.push_back(value);
  }
  return out;
}

}  // namespace tilepress
