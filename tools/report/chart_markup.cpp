// Chart markup: positions along the width are percentages, so the browser scales them; heights and texts are
// pixels.
#include "chart_markup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "html_text.h"

namespace tilepress {
namespace {

constexpr size_t kColors = 10;
constexpr size_t kShapes = 7;
constexpr size_t kDashes = 3;
constexpr int kDotRowHeight = 24;
constexpr int kBarHeight = 16;
constexpr int kBarMargin = 4;
constexpr int kScatterHeight = 340;

std::string mark_title(const ChartMark& mark) {
  return "<title>" + escape_html(mark.title) + "</title>";
}

std::string grid_lines(const AxisScale& axis, int height) {
  std::string out;
  for (const double tick : axis.ticks())
    out += fmt::format("<line class=\"grid\" x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"0\" y2=\"{1}\"/>",
                       axis.percent(tick), height);
  return out;
}

std::string row_marks(const ChartRow& row, const AxisScale& axis, RowShape shape, int height) {
  std::string out;
  double end = 0;
  int y = kBarMargin;
  for (const ChartMark& mark : row.marks) {
    if (std::isnan(mark.value)) continue;
    const size_t color = mark.color_index % kColors;
    if (shape == RowShape::kDots) {
      out += fmt::format("<use href=\"#m{}\" class=\"m c{}\" x=\"{:.2f}%\" y=\"{}\">{}</use>",
                         mark.color_index % kShapes, color, axis.percent(mark.value), height / 2,
                         mark_title(mark));
      continue;
    }
    const double from = shape == RowShape::kStack ? end : 0;
    const double start = axis.percent(from), stop = axis.percent(from + mark.value);
    out += fmt::format(
        "<rect class=\"bar c{}\" x=\"{:.3f}%\" width=\"{:.3f}%\" y=\"{}\" height=\"{}\">{}</rect>", color,
        start, stop - start, y + 2, kBarHeight - 3, mark_title(mark));
    end = from + mark.value;
    if (shape == RowShape::kBars) y += kBarHeight;
  }
  return out;
}

std::string grey_lines(const ChartRow& row, const AxisScale& axis, int height) {
  std::string out;
  for (const ChartLine& line : row.lines)
    if (axis.holds(line.value))
      out += fmt::format(
          "<line class=\"bound d{0}\" x1=\"{1:.2f}%\" x2=\"{1:.2f}%\" y1=\"0\" y2=\"{2}\"><title>{3}</title></line>",
          line.dash_index % kDashes, axis.percent(line.value), height, escape_html(line.title));
  return out;
}

std::string key_mark(const KeyEntry& entry) {
  if (entry.is_line)
    return fmt::format("<line class=\"bound d{}\" x1=\"0\" x2=\"0\" y1=\"-7\" y2=\"7\"/>",
                       entry.color_index % kDashes);
  return fmt::format("<use href=\"#m{}\" class=\"m c{}\"/>", entry.color_index % kShapes,
                     entry.color_index % kColors);
}

std::string axis_row(const AxisScale& axis) {
  std::string out = "<svg class=\"axis\" height=\"18\" aria-hidden=\"true\">";
  for (const double tick : axis.ticks())
    out += fmt::format("<text x=\"{:.2f}%\" y=\"13\" text-anchor=\"middle\">{}</text>", axis.percent(tick),
                       AxisScale::tick_text(tick));
  return out + "</svg>\n";
}

}  // namespace

// Steps of 1, 2 and 5 for linear axes, powers of two for logarithmic ones.
AxisScale AxisScale::for_rates(double low, double high) {
  if (high > 16 && low > 0) {
    AxisScale axis;
    axis.logarithmic_ = true;
    axis.low_ = std::exp2(std::floor(std::log2(std::max(low, 1e-3))));
    axis.high_ = std::exp2(std::ceil(std::log2(high)));
    for (double tick = axis.low_; tick <= axis.high_; tick *= 2) axis.ticks_.push_back(tick);
    return axis;
  }
  double step = 0.1;
  for (const double candidate : {0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0})
    if (high / step > 8) step = candidate;
  return linear(std::max(step, std::ceil(high / step) * step), step);
}

AxisScale AxisScale::linear(double top, double step) {
  AxisScale axis;
  axis.high_ = top;
  for (int i = 0; i * step <= top * 1.0001; ++i) axis.ticks_.push_back(i * step);
  return axis;
}

double AxisScale::percent(double value) const {
  const double share = logarithmic_ ? (std::log2(std::max(value, low_)) - std::log2(low_)) /
                                          (std::log2(high_) - std::log2(low_))
                                    : (value - low_) / (high_ - low_);
  return std::clamp(share, 0.0, 1.0) * 100;
}

std::string AxisScale::tick_text(double tick) {
  return fmt::format("{:.4g}", tick);
}

std::string marker_definitions() {
  static constexpr const char* kPaths[kShapes] = {
      "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0z",                              // circle
      "M-4.5 -4.5h9v9h-9z",                                                 // square
      "M0 -6l6 6l-6 6l-6 -6z",                                              // diamond
      "M0 -5.5l5.5 9.5h-11z",                                               // triangle up
      "M0 5.5l5.5 -9.5h-11z",                                               // triangle down
      "M-6 -2h4v-4h4v4h4v4h-4v4h-4v-4h-4z",                                 // plus
      "M-5 -5h3l2 3l2 -3h3v3l-3 2l3 2v3h-3l-2 -3l-2 3h-3v-3l3 -2l-3 -2z"};  // cross
  std::string out;
  for (size_t i = 0; i < kShapes; ++i) out += fmt::format("<path id=\"m{}\" d=\"{}\"/>", i, kPaths[i]);
  return out;
}

std::string chart_key(const std::vector<KeyEntry>& entries) {
  const bool grouped = std::any_of(entries.begin(), entries.end(), [&](const KeyEntry& entry) {
    return entry.group != entries.front().group;
  });
  std::string out = "<ul class=\"key\">", group;
  for (const KeyEntry& entry : entries) {
    if (grouped && entry.group != group)
      out += fmt::format("<li class=\"group\">{}:</li>", escape_html(entry.group));
    group = entry.group;
    out += fmt::format("<li><svg aria-hidden=\"true\" viewBox=\"-7 -7 14 14\">{}</svg>{}</li>", key_mark(entry),
                       escape_html(entry.label));
  }
  return out + "</ul>\n";
}

std::string row_chart(const std::vector<ChartRow>& rows, const AxisScale& axis, RowShape shape,
                      std::string_view unit, std::string_view described) {
  std::string out =
      fmt::format("<div class=\"rows\" role=\"img\" aria-label=\"{}\">\n", escape_html(described));
  std::string group;
  for (const ChartRow& row : rows) {
    if (row.group != group) out += "<div class=\"group\">" + escape_html(row.group) + "</div>\n";
    group = row.group;
    const int height = shape == RowShape::kBars
                           ? static_cast<int>(row.marks.size()) * kBarHeight + 2 * kBarMargin
                           : kDotRowHeight;
    out += fmt::format("<div class=\"label\" title=\"{0}\">{0}</div>", escape_html(row.label));
    out += fmt::format("<svg class=\"plot\" height=\"{}\">{}", height, grid_lines(axis, height));
    out += grey_lines(row, axis, height) + row_marks(row, axis, shape, height);
    if (shape == RowShape::kBars) {
      int y = kBarMargin;
      for (const ChartMark& mark : row.marks) {
        // The value stands right of the bar, or inside its end where the bar leaves no room.
        const double at = std::isnan(mark.value) ? 0 : axis.percent(mark.value);
        out += fmt::format("<text class=\"value\" x=\"{:.2f}%\" dx=\"4\" y=\"{}\">{}</text>", at,
                           y + kBarHeight - 3, shown_number(mark.value));
        y += kBarHeight;
      }
    }
    out += "</svg>\n";
  }
  out += axis_row(axis);
  return out + "<div class=\"unit\">" + escape_html(unit) + (axis.logarithmic() ? ", logarithmic" : "") +
         "</div></div>\n";
}

std::string scatter_chart(const std::vector<ScatterPoint>& points, const AxisScale& x_axis,
                          const AxisScale& y_axis, std::string_view x_unit, std::string_view y_unit,
                          double x_mark, std::string_view described) {
  const auto y_pixel = [&](double value) { return kScatterHeight * (1 - y_axis.percent(value) / 100); };
  std::string out =
      fmt::format("<div class=\"scatter\" role=\"img\" aria-label=\"{}\">\n", escape_html(described));
  out += fmt::format("<div class=\"y-unit\">{}{}</div>", escape_html(y_unit),
                     y_axis.logarithmic() ? ", logarithmic" : "");
  out += fmt::format("<svg height=\"{}\" aria-hidden=\"true\">", kScatterHeight);
  for (const double tick : y_axis.ticks())
    out += fmt::format("<text x=\"100%\" dx=\"-6\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>",
                       y_pixel(tick) + 4, AxisScale::tick_text(tick));
  out += fmt::format("</svg>\n<svg height=\"{}\">{}", kScatterHeight, grid_lines(x_axis, kScatterHeight));
  for (const double tick : y_axis.ticks())
    out += fmt::format("<line class=\"grid\" x1=\"0\" x2=\"100%\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>",
                       y_pixel(tick));
  out += fmt::format("<rect class=\"frame\" width=\"100%\" height=\"{}\"/>", kScatterHeight);
  if (!std::isnan(x_mark))
    out += fmt::format("<line class=\"threshold\" x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"0\" y2=\"{1}\"/>",
                       x_axis.percent(x_mark), kScatterHeight);
  for (const ScatterPoint& point : points)
    out +=
        fmt::format("<use href=\"#m{}\" class=\"m c{}\" x=\"{:.2f}%\" y=\"{:.1f}\"><title>{}</title></use>",
                    point.color_index % kShapes, point.color_index % kColors, x_axis.percent(point.x),
                    y_pixel(point.y), escape_html(point.title));
  out += "</svg>\n<div></div><div></div><div>" + axis_row(x_axis) + "</div>";
  return out + "<div class=\"x-unit\">" + escape_html(x_unit) + "</div></div>\n";
}

}  // namespace tilepress
