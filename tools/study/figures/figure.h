// Figure: the rows of a figure's CSV file, and what its axes say. Pages and drawings are made from these
// rows alone.
#pragma once

#include <string>
#include <vector>

#include "study/figures/study_data.h"

namespace tilepress {

struct Figure {
  FigureSpec spec{};
  StudyTable table{};
  std::string x_label{}, y_label{};
  std::string x_column{}, y_column{};  ///< columns of the table
  std::string x_scale = "linear";      ///< "linear", "log2", "log10" or "categories"
  std::vector<std::string> x_order{};  ///< texts of x, in the figure's order
  bool share = false;                  ///< y is a share of 0..1 that people read in percent
};

/// Makes a figure. Fails with kBadValue if its kind, axis or configurations are unknown, and with
/// kUnsupported if the study has no data for it.
Result<Figure> make_figure(const StudyData& data, const FigureSpec& spec);

/// The figures of the study. A study file without figures has one per axis, the rates and the means.
std::vector<FigureSpec> figure_specs(const StudyData& data);

/// figures.json: what draw_figures.py needs beside the CSV files.
std::string figures_json(const StudyData& data, const std::vector<Figure>& figures);

}  // namespace tilepress
