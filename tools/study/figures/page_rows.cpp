// Page rows: bars, dots and stacks, one row below the other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "counted.h"
#include "report/html_text.h"
#include "report/scheme_names.h"
#include "study/figures/page_figures.h"

namespace tilepress {
namespace {

constexpr size_t kFirstPartColor = 0, kRawPartColor = 9, kSecondPartColor = 1;

/// A row with a bar of the study, and one of the paper where it prints a value.
PageChart comparison_chart(const StudyData& data, const Figure& figure, const std::string& label_column) {
  const StudyTable& table = figure.table;
  std::vector<ChartRow> rows;
  ValueRange range;
  bool published = false;
  for (size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& label = table.text(row, label_column);
    const std::string group = data.category_title(table.text(row, "category"));
    const double paper = table.number(row, "published");
    ChartRow& line = rows.emplace_back(ChartRow{label, group, {}, bound_lines(figure, row)});
    const auto mark = [&](double value, size_t color, const char* owner) {
      range.add(value);
      line.marks.push_back(
          {value, color, fmt::format("{}, {}{}: {}", group, label, owner, shown_number(value))});
    };
    mark(table.number(row, figure.y_column), kOurColor, "");
    if (std::isfinite(paper)) mark(paper, kPaperColor, ", paper");
    published = published || std::isfinite(paper);
  }
  PageChart chart;
  std::vector<KeyEntry> key = {{"this study", kOurColor}};
  if (published) key.push_back({"paper", kPaperColor});
  explain_bounds(figure, key, chart.remark);
  chart.html = chart_key(key) + row_chart(rows, AxisScale::for_rates(0, range.high), RowShape::kBars,
                                          figure.y_label, figure.spec.title);
  return chart;
}

/// A chart with many rows is folded: the page stays short.
std::string folded(size_t rows, const std::string& html) {
  constexpr size_t kOpenRows = 60;
  if (rows <= kOpenRows) return html;
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", counted(rows, "workload"), html);
}

/// The workloads of a figure with the rows of each, in the figure's order.
std::vector<std::pair<std::string, std::vector<size_t>>> rows_of_workloads(const StudyTable& table) {
  std::vector<std::pair<std::string, std::vector<size_t>>> out;
  for (size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& workload = table.text(row, "workload");
    if (out.empty() || out.back().first != workload) out.emplace_back(workload, std::vector<size_t>{});
    out.back().second.push_back(row);
  }
  return out;
}

}  // namespace

std::vector<ChartLine> bound_lines(const Figure& figure, size_t row) {
  std::vector<ChartLine> lines;
  for (const DrawnBound& bound : kDrawnBounds)
    if (figure.table.has(bound.name))
      if (const double value = figure.table.number(row, bound.name); std::isfinite(value))
        lines.push_back({value, bound.dash_index, fmt::format("{}: {}", bound.label, shown_number(value))});
  return lines;
}

void explain_bounds(const Figure& figure, std::vector<KeyEntry>& key, std::string& remark) {
  for (const DrawnBound& bound : kDrawnBounds)
    if (figure.table.has(bound.name)) {
      key.push_back({.label = bound.label, .color_index = bound.dash_index, .group = "bounds", .is_line = true});
      remark = "Grey lines show what general compressors reach. Lines beyond the axis are left out.";
    }
}

PageChart axis_bars(const StudyData& data, const Figure& figure) {
  return comparison_chart(data, figure, figure.x_column);
}

PageChart mean_bars(const StudyData& data, const Figure& figure) {
  return comparison_chart(data, figure, "configuration");
}

PageChart rate_dots(const StudyData& data, const Figure& figure) {
  const StudyTable& table = figure.table;
  std::vector<KeyEntry> key;
  for (const std::string& configuration : figure.x_order)
    key.push_back({configuration, key.size(), name_of(scheme_group(configuration))});
  ValueRange range;
  std::vector<ChartRow> rows;
  for (const auto& [workload, own] : rows_of_workloads(table)) {
    ChartRow line{workload, data.category_title(table.text(own.front(), "category")), {}};
    for (const size_t row : own) {
      const std::string& configuration = table.text(row, "configuration");
      const double rate = table.number(row, figure.y_column);
      const auto place = std::find(figure.x_order.begin(), figure.x_order.end(), configuration);
      range.add(rate);
      line.marks.push_back({rate, static_cast<size_t>(place - figure.x_order.begin()),
                            fmt::format("{}, {}: {}", workload, configuration, shown_number(rate))});
    }
    line.lines = bound_lines(figure, own.front());
    rows.push_back(std::move(line));
  }
  PageChart chart;
  explain_bounds(figure, key, chart.remark);
  chart.html = folded(rows.size(),
                      chart_key(key) + row_chart(rows, AxisScale::for_rates(range.low, range.high),
                                                 RowShape::kDots, figure.y_label, figure.spec.title));
  return chart;
}

PageChart burst_dots(const StudyData& data, const Figure& figure) {
  const StudyTable& table = figure.table;
  const std::vector<std::string> bursts = table.distinct("burst");
  std::vector<KeyEntry> key;
  std::vector<ChartRow> rows;
  ValueRange range;
  for (size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& burst = table.text(row, "burst");
    const auto color = static_cast<size_t>(std::find(bursts.begin(), bursts.end(), burst) - bursts.begin());
    if (color == key.size()) {
      const std::string& dram = table.text(row, "dram");
      key.push_back({burst + " bits" + (dram.empty() ? "" : " (" + dram + ")"), color});
    }
    const std::string& configuration = table.text(row, "configuration");
    const std::string group = data.category_title(table.text(row, "category"));
    if (rows.empty() || rows.back().label != configuration || rows.back().group != group)
      rows.push_back({configuration, group, {}});
    const double rate = table.number(row, figure.y_column);
    range.add(rate);
    rows.back().marks.push_back(
        {rate, color, fmt::format("{}, {}, burst {}: {}", group, configuration, burst, shown_number(rate))});
  }
  return {.html = chart_key(key) + row_chart(rows, AxisScale::for_rates(range.low, range.high), RowShape::kDots,
                                             figure.y_label, figure.spec.title)};
}

PageChart share_stacks(const StudyData& data, const Figure& figure) {
  const StudyTable& table = figure.table;
  struct Part {
    const char* column;
    const char* label;
    size_t color;
  };
  constexpr Part kParts[] = {{"vdcp_only", "coded by VDCP", kFirstPartColor},
                             {"raw_share", "raw either way", kRawPartColor},
                             {"ras_only", "coded by RAS", kSecondPartColor}};
  std::vector<KeyEntry> key;
  for (const Part& part : kParts) key.push_back({part.label, part.color});
  std::vector<ChartRow> rows;
  for (size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& workload = table.text(row, "workload");
    ChartRow line{workload, data.category_title(table.text(row, "category")), {}};
    for (const Part& part : kParts) {
      const double share = table.number(row, part.column);
      if (std::isfinite(share))
        line.marks.push_back(
            {share * 100, part.color, fmt::format("{}, {}: {}", workload, part.label, shown_percent(share))});
    }
    rows.push_back(std::move(line));
  }
  return {.html = folded(rows.size(),
                         chart_key(key) + row_chart(rows, AxisScale::linear(100, 20), RowShape::kStack,
                                                    "share of blocks in percent", figure.spec.title))};
}

PageChart coverage_scatter(const StudyData& data, const Figure& figure) {
  const StudyTable& table = figure.table;
  std::vector<ScatterPoint> points;
  std::vector<KeyEntry> key;
  ValueRange range;
  for (size_t row = 0; row < table.rows.size(); ++row) {
    if (!table.text(row, "frame").empty()) continue;
    const double coverage = table.number(row, "fvc_coverage"), rate = table.number(row, figure.y_column);
    const size_t color = category_color(data, table.text(row, "category"));
    const std::string title = data.category_title(table.text(row, "category"));
    if (std::none_of(key.begin(), key.end(), [&](const KeyEntry& entry) { return entry.label == title; }))
      key.push_back({title, color});
    range.add(rate);
    points.push_back({coverage, rate, color,
                      fmt::format("{}: coverage {}, rate {}", table.text(row, "workload"),
                                  shown_number(coverage), shown_number(rate))});
  }
  double threshold = NAN;
  for (const PublishedPoint& point : figure.spec.published) threshold = number_or_nan(point.x);
  return {.html = chart_key(key) + scatter_chart(points, AxisScale::linear(1, 0.1),
                                                 AxisScale::for_rates(range.low, range.high), figure.x_label,
                                                 figure.y_label, threshold, figure.spec.title),
          .remark = "One mark per workload. The CSV file has the frames too."};
}

size_t category_color(const StudyData& data, const std::string& category) {
  const auto& known = data.categories();
  return static_cast<size_t>(std::find(known.begin(), known.end(), category) - known.begin());
}

}  // namespace tilepress
