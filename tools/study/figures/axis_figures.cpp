// Axis figures: a value against the values of one key.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/figures/axis_points.h"
#include "study/figures/figure_makers.h"

namespace tilepress {
namespace {

/// What an axis figure shows of a configuration.
struct AxisValue {
  std::string mean_column;    ///< of means.csv
  std::string result_column;  ///< of results.csv
};

double published_at(const FigureSpec& spec, const std::string& x, const std::string& category) {
  for (const PublishedPoint& point : spec.published)
    if (point.x == x && point.category == category) return point.value;
  return NAN;
}

/// The value divided by that of the configuration that counts as 1, if there is one.
double relative(double value, const FigureSpec& spec, double base) {
  return spec.normalized_to.empty() ? value : value / base;
}

void add_category_rows(const StudyData& data, const FigureSpec& spec, const AxisValue& shown,
                       const std::vector<AxisPoint>& points, StudyTable& table) {
  for (const std::string& category : drawn_categories(data, spec)) {
    const double base = data.mean(category, spec.normalized_to, shown.mean_column);
    for (const AxisPoint& point : points) {
      const double mean = relative(data.mean(category, point.configuration, shown.mean_column), spec, base);
      if (!std::isfinite(mean)) continue;
      const ValueSpread spread = spread_of(workload_values(data, category, [&](const std::string& workload) {
        return relative(data.result(workload, point.configuration, shown.result_column), spec,
                        data.result(workload, spec.normalized_to, shown.result_column));
      }));
      table.rows.push_back({category, point.value, point.configuration, std::to_string(spread.count),
                            number_cell_text(mean), number_cell_text(spread.minimum),
                            number_cell_text(spread.median), number_cell_text(spread.maximum),
                            number_cell_text(published_at(spec, point.value, category))});
    }
  }
}

void add_workload_rows(const StudyData& data, const FigureSpec& spec, const AxisValue& shown,
                       const std::vector<AxisPoint>& points, StudyTable& table) {
  for (const size_t row : drawn_workloads(data, spec)) {
    const std::string& workload = data.workloads.text(row, "workload");
    const std::string& category = data.workloads.text(row, "category");
    const double base = data.result(workload, spec.normalized_to, shown.result_column);
    for (const AxisPoint& point : points) {
      const double value =
          relative(data.result(workload, point.configuration, shown.result_column), spec, base);
      if (std::isfinite(value))
        table.rows.push_back({workload, category, point.value, point.configuration, number_cell_text(value)});
    }
  }
}

Result<Figure> axis_figure(const StudyData& data, const FigureSpec& spec, const AxisValue& shown,
                           const std::string& value_name) {
  const auto axis = std::ranges::find(data.spec.axes, spec.axis, &FigureAxis::name);
  if (axis == data.spec.axes.end())
    return Error{ErrorKind::kBadValue, fmt::format("the study has no axis '{}'", spec.axis)};
  const std::vector<AxisPoint> points = axis_points(data, *axis);
  if (points.empty())
    return Error{ErrorKind::kUnsupported, fmt::format("axis '{}' has no values", axis->name)};
  Figure figure{.spec = spec};
  if (spec.by_workload) {
    figure.table.header = {"workload", "category", axis->key, "configuration", value_name};
    add_workload_rows(data, spec, shown, points, figure.table);
  } else {
    figure.table.header = {"category", axis->key, "configuration", "workloads", value_name,
                           "minimum",  "median",  "maximum",       "published"};
    add_category_rows(data, spec, shown, points, figure.table);
  }
  figure.x_column = axis->key;
  figure.y_column = value_name;
  figure.x_label = axis->title.empty() ? axis->key : axis->title;
  figure.x_scale = axis_scale(points);
  for (const AxisPoint& point : points) figure.x_order.push_back(point.value);
  return figure;
}

}  // namespace

Result<Figure> rate_over_axis(const StudyData& data, const FigureSpec& spec) {
  const std::string name = spec.normalized_to.empty() ? spec.value : "relative_" + spec.value;
  auto figure = axis_figure(data, spec, {spec.value + "_hmean", spec.value}, name);
  if (figure) {
    if (!spec.by_workload) add_bound_columns(data, spec, figure->table);
    figure->y_label = rate_label(spec);
    figure->share = !spec.normalized_to.empty();
  }
  return figure;
}

Result<Figure> relative_coverage_over_axis(const StudyData& data, const FigureSpec& spec) {
  auto figure = axis_figure(data, spec, {"fvc_relative_coverage_mean", "fvc_relative_coverage"},
                            "fvc_relative_coverage");
  if (figure) {
    figure->y_label = "relative coverage of the FVC";
    figure->share = true;
  }
  return figure;
}

}  // namespace tilepress
