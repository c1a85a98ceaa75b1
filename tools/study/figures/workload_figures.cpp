// Workload figures: rates and block shares of each workload, and the means of categories.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/scheme_names.h"
#include "study/figures/figure_makers.h"
#include "study/figures/hybrid_blocks.h"

namespace tilepress {
namespace {

/// The configurations of the figure that the study has results of. An empty list in the figure means all
/// schemes without keys, by group.
std::vector<std::string> drawn_configurations(const StudyData& data, const FigureSpec& spec) {
  const std::vector<std::string>& known = data.configurations();
  std::vector<std::string> out;
  if (spec.configurations.empty()) {
    for (const std::string& configuration : known)
      if (configuration.find(':') == std::string::npos) out.push_back(configuration);
    std::stable_sort(out.begin(), out.end(), [](const std::string& a, const std::string& b) {
      return scheme_group(a) < scheme_group(b);
    });
    return out;
  }
  for (const std::string& configuration : spec.configurations)
    if (std::find(known.begin(), known.end(), configuration) != known.end()) out.push_back(configuration);
  return out;
}

}  // namespace

Result<Figure> rates_of_workloads(const StudyData& data, const FigureSpec& spec) {
  Figure figure{.spec = spec};
  figure.table.header = {"workload", "category", "order", "configuration", spec.value};
  for (size_t order = 1; const size_t row : drawn_workloads(data, spec)) {
    const std::string& workload = data.workloads.text(row, "workload");
    for (const std::string& configuration : drawn_configurations(data, spec)) {
      const double rate = data.result(workload, configuration, spec.value);
      if (std::isfinite(rate))
        figure.table.rows.push_back({workload, data.workloads.text(row, "category"), std::to_string(order),
                                     configuration, number_cell_text(rate)});
    }
    ++order;
  }
  add_bound_columns(data, spec, figure.table);
  figure.x_column = "order";
  figure.y_column = spec.value;
  figure.x_label = "workload";
  figure.y_label = rate_label(spec);
  figure.x_order = drawn_configurations(data, spec);
  return figure;
}

Result<Figure> means_of_categories(const StudyData& data, const FigureSpec& spec) {
  Figure figure{.spec = spec};
  figure.table.header = {"category", "configuration", "workloads", spec.value,
                         "minimum",  "median",        "maximum",   "published"};
  for (const std::string& category : drawn_categories(data, spec))
    for (const std::string& configuration : drawn_configurations(data, spec)) {
      const double mean = data.mean(category, configuration, spec.value + "_hmean");
      if (!std::isfinite(mean)) continue;
      const ValueSpread spread = spread_of(workload_values(data, category, [&](const std::string& workload) {
        return data.result(workload, configuration, spec.value);
      }));
      double published = NAN;
      for (const PublishedPoint& point : spec.published)
        if (point.x == configuration && point.category == category) published = point.value;
      figure.table.rows.push_back({category, configuration, std::to_string(spread.count),
                                   number_cell_text(mean), number_cell_text(spread.minimum),
                                   number_cell_text(spread.median), number_cell_text(spread.maximum),
                                   number_cell_text(published)});
    }
  add_bound_columns(data, spec, figure.table);
  figure.x_column = "category";
  figure.y_column = spec.value;
  figure.y_label = rate_label(spec) + ", harmonic mean";
  figure.x_scale = "categories";
  figure.x_order = drawn_configurations(data, spec);
  return figure;
}

Result<Figure> rate_over_bursts(const StudyData& data, const FigureSpec& spec) {
  const StudyTable& table = data.sensitivity;
  if (table.row_count() == 0)
    return Error{ErrorKind::kUnsupported, "the study has one burst only (list several: bursts = [128, 256])"};
  const std::vector<std::string> configurations = drawn_configurations(data, spec);
  const std::vector<std::string> categories = drawn_categories(data, spec);
  Figure figure{.spec = spec};
  figure.table.header = {"category", "configuration", "burst", "dram", "workloads", spec.value, "minimum", "median",
                         "maximum"};
  for (const std::string& category : categories)
    for (const std::string& configuration : configurations)
      for (size_t row = 0; row < table.row_count(); ++row) {
        if (table.text(row, "category") != category || table.text(row, "configuration") != configuration) continue;
        figure.table.rows.push_back({category, configuration, table.text(row, "burst_bits"), table.text(row, "dram"),
                                     table.text(row, "workloads"), table.text(row, spec.value + "_hmean"),
                                     table.text(row, spec.value + "_min"), table.text(row, spec.value + "_median"),
                                     table.text(row, spec.value + "_max")});
      }
  figure.x_column = "configuration";
  figure.y_column = spec.value;
  figure.y_label = rate_label(spec) + ", harmonic mean";
  figure.x_scale = "categories";
  figure.x_order = configurations;
  return figure;
}

Result<Figure> hybrid_shares(const StudyData& data, const FigureSpec& spec) {
  const std::string configuration = spec.configurations.empty() ? "hdcp" : spec.configurations.front();
  Figure figure{.spec = spec};
  figure.table.header = {"workload",  "category",  "order",     "blocks",  "vdcp_share",
                         "ras_share", "raw_share", "vdcp_only", "ras_only"};
  for (const size_t row : drawn_workloads(data, spec)) {
    const std::string& workload = data.workloads.text(row, "workload");
    const HybridBlocks blocks = hybrid_blocks(data, workload, configuration);
    if (!(blocks.all() > 0)) continue;
    const std::string order = std::to_string(figure.table.rows.size() + 1);
    auto& cells = figure.table.rows.emplace_back(
        std::vector{workload, data.workloads.text(row, "category"), order, number_cell_text(blocks.all())});
    for (const double part : {blocks.vdcp, blocks.ras, blocks.raw, blocks.vdcp_only(), blocks.ras_only()})
      cells.push_back(number_cell_text(part / blocks.all()));
  }
  figure.x_column = "order";
  figure.y_column = "vdcp_share";
  figure.x_label = "workload";
  figure.y_label = "share of blocks";
  figure.share = true;
  return figure;
}

}  // namespace tilepress
