// Page lines: a parameter against a value, as lines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/html_text.h"
#include "study/figures/page_figures.h"

namespace tilepress {
namespace {

constexpr size_t kMaxLines = 10;     ///< more lines in one chart cannot be told apart
constexpr size_t kMaxPoints = 1200;  ///< positions along x
constexpr double kZoomShare = 0.7;  ///< an axis starts above 0 if no value is below this share of the largest
constexpr size_t kGreyColor = 9;

LinePlot empty_plot(const Figure& figure) {
  LinePlot plot{.id = figure.spec.name};
  plot.x_name = figure.x_column;
  plot.x_unit = figure.x_label;
  plot.y_unit = figure.y_label;
  plot.file = figure.spec.name + ".csv";
  return plot;
}

/// Positions of the axis. Numbers on a linear axis stay; other axes have a position per value.
class AxisPositions {
 public:
  explicit AxisPositions(const Figure& figure)
      : order_(figure.x_order), linear_(figure.x_scale == "linear") {}
  void fill(LinePlot& plot) const {
    for (size_t i = 0; i < order_.size(); ++i) plot.x.push_back(linear_ ? std::stod(order_[i]) : double(i));
    if (!linear_) plot.x_labels = order_;
  }
  size_t index(const std::string& text) const {
    return static_cast<size_t>(std::find(order_.begin(), order_.end(), text) - order_.begin());
  }

 private:
  const std::vector<std::string>& order_;
  bool linear_;
};

void set_bottom(LinePlot& plot) {
  double low = INFINITY, high = 0;
  for (const PlotLine& line : plot.lines)
    for (const double value : line.y)
      if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (low > kZoomShare * high && high > low) plot.y_min = std::floor((low - (high - low) * 0.1) * 100) / 100;
}

/// At most kMaxLines of some names, evenly spread.
std::vector<std::string> spread_choice(const std::vector<std::string>& names) {
  if (names.size() <= kMaxLines) return names;
  std::vector<std::string> out;
  for (size_t i = 0; i < kMaxLines; ++i) out.push_back(names[i * (names.size() - 1) / (kMaxLines - 1)]);
  return out;
}

std::string choice_remark(size_t shown, size_t all) {
  return shown == all ? "" : fmt::format("{} of {} workloads are drawn. The CSV file has all.", shown, all);
}

/// A grey line per category: what zstd reaches on each block alone.
void add_bound_lines(const StudyData& data, const Figure& figure, LinePlot& plot) {
  constexpr const char* kBound = "zstd_block";
  if (!figure.table.has(kBound)) return;
  for (const std::string& category : figure.table.distinct("category")) {
    const double value = data.bound_mean(category, kBound, figure.spec.value + "_hmean");
    if (std::isfinite(value))
      plot.lines.push_back({data.category_title(category) + ", zstd on each block", kGreyColor,
                            std::vector<double>(plot.x.size(), value)});
  }
}

bool mostly_words(const Figure& figure) {
  const auto words = std::ranges::count_if(figure.x_order, [](const std::string& text) {
    return text.empty() || text.find_first_not_of("0123456789.") != std::string::npos;
  });
  return 2 * static_cast<size_t>(words) > figure.x_order.size();
}

PageChart axis_lines(const StudyData& data, const Figure& figure) {
  LinePlot plot = empty_plot(figure);
  const AxisPositions positions(figure);
  positions.fill(plot);
  const StudyTable& table = figure.table;
  for (const std::string& category : table.distinct("category")) {
    const size_t color = category_color(data, category);
    PlotLine ours{data.category_title(category), color, std::vector<double>(plot.x.size(), NAN)};
    PlotLine paper{ours.name + ", paper", color, ours.y, true};
    for (size_t row = 0; row < table.rows.size(); ++row) {
      if (table.text(row, "category") != category) continue;
      const size_t at = positions.index(table.text(row, figure.x_column));
      ours.y[at] = table.number(row, figure.y_column);
      paper.y[at] = table.number(row, "published");
    }
    const bool published =
        std::any_of(paper.y.begin(), paper.y.end(), [](double y) { return std::isfinite(y); });
    plot.lines.push_back(std::move(ours));
    if (published) plot.lines.push_back(std::move(paper));
  }
  add_bound_lines(data, figure, plot);
  set_bottom(plot);
  return {.lines = {{"", {std::move(plot)}}}};
}

PageChart workload_lines(const Figure& figure) {
  LinePlot plot = empty_plot(figure);
  const AxisPositions positions(figure);
  positions.fill(plot);
  const StudyTable& table = figure.table;
  const std::vector<std::string> workloads = table.distinct("workload");
  const std::vector<std::string> chosen = spread_choice(workloads);
  for (size_t i = 0; i < chosen.size(); ++i) {
    PlotLine line{chosen[i], i, std::vector<double>(plot.x.size(), NAN)};
    for (size_t row = 0; row < table.rows.size(); ++row)
      if (table.text(row, "workload") == chosen[i])
        line.y[positions.index(table.text(row, figure.x_column))] = table.number(row, figure.y_column);
    plot.lines.push_back(std::move(line));
  }
  set_bottom(plot);
  return {.lines = {{"", {std::move(plot)}}}, .remark = choice_remark(chosen.size(), workloads.size())};
}

}  // namespace

PageChart axis_chart(const StudyData& data, const Figure& figure) {
  if (figure.spec.by_workload) return workload_lines(figure);
  return mostly_words(figure) ? axis_bars(data, figure) : axis_lines(data, figure);
}

PageChart change_lines(const StudyData&, const Figure& figure) {
  const StudyTable& table = figure.table;
  std::map<std::pair<std::string, std::string>, std::vector<size_t>> rows;
  for (size_t row = 0; row < table.rows.size(); ++row)
    rows[{table.text(row, "workload"), table.text(row, "surface")}].push_back(row);
  PageChart chart{.picked = "Workload"};
  for (const std::string& workload : table.distinct("workload"))
    for (const auto& [key, own] : rows) {
      if (key.first != workload) continue;
      LinePlot plot = empty_plot(figure);
      plot.title = workload;
      plot.y_max = 1;
      plot.file = fmt::format("{}-{}-surface{}.csv", figure.spec.name, file_slug(workload), key.second);
      plot.lines = {{"pixel change", 0, {}}, {"colour change", 1, {}}};
      const std::string& category = table.text(own.front(), "category");
      for (const PublishedPoint& point : figure.spec.published)
        if (point.category == category)
          plot.lines.push_back(
              point.x == "pixel_change"
                  ? PlotLine{"pixel change, paper's mean", 5, std::vector(own.size(), point.value)}
                  : PlotLine{"colour change, paper's mean", 4, std::vector(own.size(), point.value)});
      for (const size_t row : own) {
        plot.x.push_back(table.number(row, "frame"));
        plot.lines[0].y.push_back(table.number(row, "pixel_change"));
        plot.lines[1].y.push_back(table.number(row, "color_change"));
      }
      reduce_line_plot(plot, kMaxPoints);
      std::string label = category.empty() ? workload : workload + " (" + category + ")";
      if (key.second != "0") label += ", surface " + key.second;
      chart.lines.push_back({std::move(label), {std::move(plot)}});
    }
  return chart;
}

PageChart cdf_lines(const StudyData&, const Figure& figure) {
  LinePlot plot = empty_plot(figure);
  const StudyTable& table = figure.table;
  plot.x_log = true;
  plot.y_max = 1;
  const std::vector<std::string> workloads = table.distinct("workload");
  const std::vector<std::string> chosen = spread_choice(workloads);
  std::map<double, std::map<std::string, double>> cells;
  for (size_t row = 0; row < table.rows.size(); ++row)
    cells[table.number(row, "colors")][table.text(row, "workload")] = table.number(row, "pixels_share");
  for (size_t i = 0; i < chosen.size(); ++i) plot.lines.push_back({chosen[i], i, {}});
  std::vector<PlotLine> paper;
  std::vector<PublishedPoint> marks;
  for (const PublishedPoint& point : figure.spec.published) {
    if (std::isnan(number_or_nan(point.x))) continue;
    cells[number_or_nan(point.x)];
    marks.push_back(point);
    paper.push_back({"paper, " + point.category, plot.lines.size() + paper.size(), {}, true});
  }
  for (const auto& [colors, shares] : cells) {
    plot.x.push_back(colors);
    for (size_t i = 0; i < chosen.size(); ++i) {
      const auto found = shares.find(chosen[i]);
      plot.lines[i].y.push_back(found == shares.end() ? NAN : found->second);
    }
    for (size_t i = 0; i < paper.size(); ++i) {
      paper[i].y.push_back(number_or_nan(marks[i].x) == colors ? marks[i].value : NAN);
    }
  }
  plot.lines.insert(plot.lines.end(), paper.begin(), paper.end());
  return {.lines = {{"", {std::move(plot)}}}, .remark = choice_remark(chosen.size(), workloads.size())};
}

}  // namespace tilepress
