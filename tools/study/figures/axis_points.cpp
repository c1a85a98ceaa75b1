// Axis points: joins the default configuration and sorts numbers.
#include "study/figures/axis_points.h"

#include <algorithm>
#include <cmath>

namespace tilepress {
namespace {

constexpr double kLogarithmicSpan = 16;

/// Position on the axis: numbers by size, then words.
double order_of(const AxisPoint& point) {
  const double number = number_or_nan(point.value);
  return std::isnan(number) ? INFINITY : number;
}

void join_default(const StudyData& data, const FigureAxis& axis, std::vector<AxisPoint>& points) {
  const auto same = [&](const AxisPoint& point) { return point.configuration == axis.scheme; };
  if (std::any_of(points.begin(), points.end(), same)) return;
  for (size_t row = 0; row < data.results.row_count(); ++row) {
    if (data.results.text(row, "configuration") != axis.scheme) continue;
    const std::string value = data.key_text(row, axis.key);
    const bool known =
        value.empty() || std::any_of(points.begin(), points.end(),
                                     [&](const AxisPoint& point) { return point.value == value; });
    const bool words = !points.empty() && std::isnan(number_or_nan(points.front().value));
    if (!known) points.insert(words ? points.begin() : points.end(), {value, axis.scheme});
    return;
  }
}

}  // namespace

std::vector<AxisPoint> axis_points(const StudyData& data, const FigureAxis& axis) {
  std::vector<AxisPoint> points;
  for (size_t i = 0; i < axis.configurations.size(); ++i)
    points.push_back(
        {i < axis.values.size() ? axis.values[i] : axis.configurations[i], axis.configurations[i]});
  join_default(data, axis, points);
  std::stable_sort(points.begin(), points.end(),
                   [](const AxisPoint& a, const AxisPoint& b) { return order_of(a) < order_of(b); });
  return points;
}

std::string axis_scale(const std::vector<AxisPoint>& points) {
  double low = INFINITY, high = 0;
  bool powers = true;
  for (const AxisPoint& point : points) {
    const double value = number_or_nan(point.value);
    if (std::isnan(value)) return "categories";
    low = std::min(low, value);
    high = std::max(high, value);
    powers = powers && value > 0 && std::exp2(std::round(std::log2(value))) == value;
  }
  return powers && low > 0 && high / low >= kLogarithmicSpan ? "log2" : "linear";
}

}  // namespace tilepress
