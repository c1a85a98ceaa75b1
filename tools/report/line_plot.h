// Line plot: lines over one common axis, reduced to what a screen can show, as JSON for the page's script.
#pragma once

#include <string>
#include <vector>

namespace tilepress {

struct PlotLine {
  std::string name;
  size_t color_index = 0;
  std::vector<double> y;     ///< one per x; NaN = no value there
  bool points_only = false;  ///< rings without a line
};

struct LinePlot {
  std::string id{}, title{}, note{};
  std::string x_name{};            ///< heading of the first CSV column
  std::string x_unit{}, y_unit{};  ///< texts of the axes
  std::string file{};              ///< name of the CSV download
  bool x_log = false;
  double y_min = 0;                     ///< bottom of the y axis
  double y_max = 0;                     ///< top of the y axis; 0 = from the values
  std::vector<double> x{};              ///< ascending
  std::vector<std::string> x_labels{};  ///< texts of x = 0, 1, 2, …; empty: the numbers themselves
  std::vector<PlotLine> lines{};
};

/// Reduces the plot to at most `max_points` (≥ 2) positions: the range is cut into columns of equally many
/// points; of a column each line keeps its smallest and its largest value, in the order they occur, at the
/// column's first and last x. Every value kept is one of the input's. Returns the number of points in a
/// column, 1 if nothing was reduced.
size_t reduce_line_plot(LinePlot& plot, size_t max_points);

/// The plot as a JSON object. Values have 6 significant digits.
std::string line_plot_json(const LinePlot& plot);

}  // namespace tilepress
