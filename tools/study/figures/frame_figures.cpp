// Frame figures: metrics over time, colours, and coverage against rate.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "study/figures/figure_makers.h"

namespace tilepress {
namespace {

/// The rows of a long-form table by workload, for the figure's workloads in the paper's order.
std::vector<std::pair<size_t, std::vector<size_t>>> rows_by_workload(const StudyData& data,
                                                                     const FigureSpec& spec,
                                                                     const StudyTable& table) {
  std::map<std::string, std::vector<size_t>> rows;
  for (size_t row = 0; row < table.row_count(); ++row) rows[table.text(row, "workload")].push_back(row);
  std::vector<std::pair<size_t, std::vector<size_t>>> out;
  for (const size_t workload : drawn_workloads(data, spec))
    if (const auto found = rows.find(data.workloads.text(workload, "workload")); found != rows.end())
      out.emplace_back(workload, found->second);
  return out;
}

Error no_file(const char* file) {
  return Error{ErrorKind::kUnsupported, fmt::format("no workload has rows in {}", file)};
}

}  // namespace

Result<Figure> metrics_over_time(const StudyData& data, const FigureSpec& spec) {
  constexpr const char* kMetrics[] = {"pixel_change", "color_change"};
  const StudyTable& table = data.frame_metrics;
  if (table.row_count() == 0) return no_file("frame_metrics.csv");
  Figure figure{.spec = spec};
  figure.table.header = {"workload", "category", "surface", "frame", "pixel_change", "color_change"};
  for (const auto& [workload, rows] : rows_by_workload(data, spec, table))
    for (const size_t row : rows) {
      if (table.text(row, "warmup") == "1") continue;
      std::vector<std::string> cells = {table.text(row, "workload"),
                                        data.workloads.text(workload, "category"), table.text(row, "surface"),
                                        table.text(row, "frame")};
      for (const char* metric : kMetrics) cells.push_back(table.text(row, metric));
      figure.table.rows.push_back(std::move(cells));
    }
  figure.x_column = "frame";
  figure.y_column = "pixel_change";
  figure.x_label = "frame";
  figure.y_label = "change since the frame before";
  figure.share = true;
  return figure;
}

Result<Figure> color_cdf_figure(const StudyData& data, const FigureSpec& spec) {
  const StudyTable& table = data.color_cdf;
  if (table.row_count() == 0) return no_file("color_cdf.csv");
  Figure figure{.spec = spec};
  figure.table.header = {"workload", "category", "colors", "pixels_share"};
  for (const auto& [workload, rows] : rows_by_workload(data, spec, table))
    for (const size_t row : rows)
      figure.table.rows.push_back({table.text(row, "workload"), data.workloads.text(workload, "category"),
                                   table.text(row, "colors"), table.text(row, "pixels_share")});
  figure.x_column = "colors";
  figure.y_column = "pixels_share";
  figure.x_label = "most frequent colours";
  figure.y_label = "share of pixels covered";
  figure.x_scale = "log10";
  figure.share = true;
  return figure;
}

Result<Figure> coverage_against_rate(const StudyData& data, const FigureSpec& spec) {
  const std::string configuration =
      spec.configurations.empty() ? data.spec.baseline : spec.configurations.front();
  Figure figure{.spec = spec};
  // A row without a frame is the workload's mean coverage and its rate.
  figure.table.header = {"workload", "category",     "configuration", "surface",
                         "frame",    "fvc_coverage", spec.value};
  for (const size_t row : drawn_workloads(data, spec)) {
    const std::string& workload = data.workloads.text(row, "workload");
    const std::string& category = data.workloads.text(row, "category");
    double coverage = data.result(workload, configuration, "fvc_coverage");
    if (std::isnan(coverage)) coverage = data.workloads.number(row, "fvc_coverage");
    const double rate = data.result(workload, configuration, spec.value);
    if (std::isfinite(coverage) && std::isfinite(rate))
      figure.table.rows.push_back(
          {workload, category, configuration, "", "", number_cell_text(coverage), number_cell_text(rate)});
  }
  const StudyTable& frames = data.frame_rates;
  for (const auto& [workload, rows] : rows_by_workload(data, spec, frames))
    for (const size_t row : rows) {
      if (frames.text(row, "configuration") != configuration ||
          std::isnan(frames.number(row, "fvc_coverage")))
        continue;
      figure.table.rows.push_back({frames.text(row, "workload"), data.workloads.text(workload, "category"),
                                   configuration, frames.text(row, "surface"), frames.text(row, "frame"),
                                   frames.text(row, "fvc_coverage"), frames.text(row, spec.value)});
    }
  figure.x_column = "fvc_coverage";
  figure.y_column = spec.value;
  figure.x_label = "FVC coverage";
  figure.y_label = rate_label(spec) + " of " + configuration;
  return figure;
}

}  // namespace tilepress
