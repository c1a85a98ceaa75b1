// Page figures: the figures of a study as charts of its page.
#pragma once

#include <string>
#include <vector>

#include "report/chart_markup.h"
#include "report/surface_plots.h"
#include "study/figures/figure.h"

namespace tilepress {

/// What a page draws of a figure: markup, or line charts for the page's script.
struct PageChart {
  std::string html{};
  std::vector<SurfacePlots> lines{};  ///< one plot each
  std::string picked{};               ///< what a picker chooses among `lines`: "Workload"
  std::string remark{};               ///< what the chart leaves out
};

/// Precondition: make_figure() made the figure.
PageChart page_chart(const StudyData& data, const Figure& figure);

// The kinds. Line charts:
/// Bars if the axis has mostly words.
PageChart axis_chart(const StudyData& data, const Figure& figure);
PageChart change_lines(const StudyData& data, const Figure& figure);
PageChart cdf_lines(const StudyData& data, const Figure& figure);
// Rows of marks:
PageChart axis_bars(const StudyData& data, const Figure& figure);
PageChart mean_bars(const StudyData& data, const Figure& figure);
PageChart rate_dots(const StudyData& data, const Figure& figure);
PageChart burst_dots(const StudyData& data, const Figure& figure);
PageChart share_stacks(const StudyData& data, const Figure& figure);
PageChart coverage_scatter(const StudyData& data, const Figure& figure);

/// A bound that figures draw. lz4_frame and zstd_frame are in the tables alone: five lines cannot be told apart.
struct DrawnBound {
  const char* name;
  const char* label;
  size_t dash_index;
};
inline constexpr DrawnBound kDrawnBounds[] = {{"lz4_block", "LZ4, each block alone", 1},
                                              {"zstd_block", "zstd, each block alone", 0},
                                              {"webp_frame", "WebP lossless, whole frame", 2}};
/// The grey lines of a row of the figure. None without bounds.
std::vector<ChartLine> bound_lines(const Figure& figure, size_t row);
/// Adds the grey lines of the figure to a key, and what to know about them to a remark.
void explain_bounds(const Figure& figure, std::vector<KeyEntry>& key, std::string& remark);

/// The colour of a category on the page.
size_t category_color(const StudyData& data, const std::string& category);
/// Colours of the marks "this study" and "paper".
inline constexpr size_t kOurColor = 0, kPaperColor = 1;

}  // namespace tilepress
