// Chart markup: dot, bar and scatter charts as HTML and SVG that fit any width, need no script and print as
// they are.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace tilepress {

/// The smallest and the largest of some values.
struct ValueRange {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// A linear axis from 0, or a logarithmic one between powers of two.
class AxisScale {
 public:
  /// An axis for values up to `high`; logarithmic if `high` passes 16 and `low` > 0.
  static AxisScale for_rates(double low, double high);
  /// A linear axis from 0 to `top`, ticks every `step`.
  static AxisScale linear(double top, double step);

  bool holds(double value) const { return value >= low_ && value <= high_; }
  /// Position of `value` along the axis, 0..100 percent, clamped.
  double percent(double value) const;
  const std::vector<double>& ticks() const { return ticks_; }
  bool logarithmic() const { return logarithmic_; }
  static std::string tick_text(double tick);

 private:
  double low_ = 0, high_ = 1;
  bool logarithmic_ = false;
  std::vector<double> ticks_;
};

/// One mark of a row: a dot, or a bar from the end of the bar before it.
struct ChartMark {
  double value = 0;
  size_t color_index = 0;  ///< colour and marker shape
  std::string title;       ///< what a pointer sees
};

/// A thin grey line through a row. Rows with equal lines show one line from top to bottom.
struct ChartLine {
  double value = 0;
  size_t dash_index = 0;  ///< solid, dotted or dashed
  std::string title;      ///< what a pointer sees
};

struct ChartRow {
  std::string label;
  std::string group;  ///< a new heading is written where this changes
  std::vector<ChartMark> marks;
  std::vector<ChartLine> lines{};  ///< a line beyond the axis is left out
};

struct KeyEntry {
  std::string label;
  size_t color_index = 0;
  std::string group{};  ///< named before its first entry, if the entries have several
  bool is_line = false;  ///< color_index is the dash of a ChartLine
};

enum class RowShape { kDots, kBars, kStack };

/// Definitions of the marker shapes, for the page's <defs>.
std::string marker_definitions();
std::string chart_key(const std::vector<KeyEntry>& entries);

/// Rows one below the other on one horizontal axis. kBars draws a thin bar with its value for each mark,
/// kStack puts a row's marks end to end. `described` is the text alternative.
std::string row_chart(const std::vector<ChartRow>& rows, const AxisScale& axis, RowShape shape,
                      std::string_view unit, std::string_view described);

struct ScatterPoint {
  double x = 0, y = 0;
  size_t color_index = 0;
  std::string title;
};
/// `x_mark`: a dashed vertical line there; NaN = none.
std::string scatter_chart(const std::vector<ScatterPoint>& points, const AxisScale& x_axis,
                          const AxisScale& y_axis, std::string_view x_unit, std::string_view y_unit,
                          double x_mark, std::string_view described);

}  // namespace tilepress
