// Line plot: the min/max reduction and the JSON text.
#include "line_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "html_text.h"

namespace tilepress {
namespace {

void append_values(const std::vector<double>& values, std::string& out) {
  out += '[';
  for (size_t i = 0; i < values.size(); ++i) {
    if (i > 0) out += ',';
    if (std::isfinite(values[i]))
      fmt::format_to(std::back_inserter(out), "{:.6g}", values[i]);
    else
      out += "null";
  }
  out += ']';
}

/// Smallest and largest value of y[first, last) in the order they occur; NaN if there is none.
std::pair<double, double> extremes(const std::vector<double>& y, size_t first, size_t last) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  size_t low = last, high = last;
  for (size_t i = first; i < last; ++i) {
    if (std::isnan(y[i])) continue;
    if (low == last || y[i] < y[low]) low = i;
    if (high == last || y[i] > y[high]) high = i;
  }
  if (low == last) return {kNone, kNone};
  return {y[std::min(low, high)], y[std::max(low, high)]};
}

}  // namespace

size_t reduce_line_plot(LinePlot& plot, size_t max_points) {
  const size_t count = plot.x.size();
  if (count <= max_points) return 1;
  const size_t columns = std::max<size_t>(1, max_points / 2);
  const size_t width = (count + columns - 1) / columns;
  std::vector<double> x;
  std::vector<std::vector<double>> y(plot.lines.size());
  for (size_t first = 0; first < count; first += width) {
    const size_t last = std::min(first + width, count);
    const bool single = last - first == 1;
    x.push_back(plot.x[first]);
    if (!single) x.push_back(plot.x[last - 1]);
    for (size_t line = 0; line < plot.lines.size(); ++line) {
      const auto [early, late] = extremes(plot.lines[line].y, first, last);
      y[line].push_back(early);
      if (!single) y[line].push_back(late);
    }
  }
  plot.x = std::move(x);
  for (size_t line = 0; line < plot.lines.size(); ++line) plot.lines[line].y = std::move(y[line]);
  return width;
}

std::string line_plot_json(const LinePlot& plot) {
  std::string out = "{";
  const std::pair<const char*, const std::string*> texts[] = {
      {"id", &plot.id},         {"title", &plot.title},   {"note", &plot.note}, {"x_name", &plot.x_name},
      {"x_unit", &plot.x_unit}, {"y_unit", &plot.y_unit}, {"file", &plot.file}};
  for (const auto& [name, text] : texts) out += fmt::format("\"{}\":\"{}\",", name, escape_json(*text));
  out += fmt::format("\"x_log\":{},\"y_min\":{:.6g},\"y_max\":{:.6g},\"x\":", plot.x_log, plot.y_min,
                     plot.y_max);
  append_values(plot.x, out);
  if (!plot.x_labels.empty()) {
    out += ",\"x_labels\":[";
    for (size_t i = 0; i < plot.x_labels.size(); ++i)
      out += fmt::format("{}\"{}\"", i > 0 ? "," : "", escape_json(plot.x_labels[i]));
    out += ']';
  }
  out += ",\"series\":[";
  for (size_t i = 0; i < plot.lines.size(); ++i) {
    const PlotLine& line = plot.lines[i];
    out += fmt::format("{}{{\"name\":\"{}\",\"color\":{},\"y\":", i > 0 ? "," : "", escape_json(line.name),
                       line.color_index);
    append_values(line.y, out);
    out += line.points_only ? ",\"points_only\":true}" : "}";
  }
  return out + "]}";
}

}  // namespace tilepress
