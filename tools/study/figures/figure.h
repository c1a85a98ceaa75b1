// Figure: the rows of a figure's CSV file, and what its axes say. Pages and drawings are made from these
// rows alone.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/figures/study_data.h"

namespace tilepress {

struct FigureTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  /// RFC 4180, with the header row.
  std::string csv() const;
  bool has(std::string_view column) const;
  /// Precondition: the table has the column.
  const std::string& text(size_t row, std::string_view column) const;
  /// NaN for an empty cell or a word.
  double number(size_t row, std::string_view column) const;
  /// The texts of a column, each once, in the order they first appear.
  std::vector<std::string> distinct(std::string_view column) const;
};

struct Figure {
  FigureSpec spec{};
  FigureTable table{};
  std::string x_label{}, y_label{};
  std::string x_column{}, y_column{};  ///< columns of the table
  std::string x_scale = "linear";      ///< "linear", "log2", "log10" or "categories"
  std::vector<std::string> x_order{};  ///< texts of x, in the figure's order
  bool share = false;                  ///< y is a share of 0..1 that people read in percent
};

/// One kind of figure that a study file may name.
struct FigureKind {
  const char* name;
  Result<Figure> (*make)(const StudyData& data, const FigureSpec& spec);
};
std::span<const FigureKind> figure_kinds();

/// Makes a figure. Fails with kBadValue if its kind, axis or configurations are unknown, and with
/// kUnsupported if the study has no data for it.
Result<Figure> make_figure(const StudyData& data, const FigureSpec& spec);

/// The figures of the study. A study file without figures has one per axis, the rates and the means.
std::vector<FigureSpec> figure_specs(const StudyData& data);

/// figures.json: what draw_figures.py needs beside the CSV files.
std::string figures_json(const StudyData& data, const std::vector<Figure>& figures);

}  // namespace tilepress
