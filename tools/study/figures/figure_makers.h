// Figure makers: one function per kind of figure, and what they share.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/figures/figure.h"

namespace tilepress {

// Kinds over an axis.
Result<Figure> rate_over_axis(const StudyData& data, const FigureSpec& spec);
Result<Figure> relative_coverage_over_axis(const StudyData& data, const FigureSpec& spec);
// Kinds over workloads and categories.
Result<Figure> rates_of_workloads(const StudyData& data, const FigureSpec& spec);
Result<Figure> means_of_categories(const StudyData& data, const FigureSpec& spec);
Result<Figure> rate_over_bursts(const StudyData& data, const FigureSpec& spec);
Result<Figure> hybrid_shares(const StudyData& data, const FigureSpec& spec);
// Kinds over frames.
Result<Figure> metrics_over_time(const StudyData& data, const FigureSpec& spec);
Result<Figure> color_cdf_figure(const StudyData& data, const FigureSpec& spec);
Result<Figure> coverage_against_rate(const StudyData& data, const FigureSpec& spec);

/// A number as a CSV cell; empty for NaN.
std::string number_cell_text(double value);
/// The rows of workloads.csv to draw, in the paper's order.
std::vector<size_t> drawn_workloads(const StudyData& data, const FigureSpec& spec);
/// The categories to draw: those that the figure or its published values name, otherwise all but
/// kAllCategories unless that is the only one.
std::vector<std::string> drawn_categories(const StudyData& data, const FigureSpec& spec);
/// What the y axis of a rate says.
std::string rate_label(const FigureSpec& spec);

/// Adds a column per bound of the study, which figures draw as grey lines: the bound's value for the workload of
/// each row, or else for its category. Relative values get none.
void add_bound_columns(const StudyData& data, const FigureSpec& spec, StudyTable& table);

/// Smallest, middle and largest of some values. NaN without values.
struct ValueSpread {
  double minimum, median, maximum;
  size_t count;
};
ValueSpread spread_of(const std::vector<double>& values);
/// The finite values of a category's workloads.
std::vector<double> workload_values(const StudyData& data, const std::string& category,
                                    const std::function<double(const std::string& workload)>& value_of);

}  // namespace tilepress
