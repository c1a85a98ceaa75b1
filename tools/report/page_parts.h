// Page parts: the batch that a report shows, and the shape of every section of the page.
#pragma once

#include <string>
#include <vector>

#include "chart_markup.h"
#include "html_text.h"
#include "run_summary.h"
#include "tilepress/cost_model.h"

namespace tilepress {

/// Everything that a report shows. The runs have the paper's order: by category (UI, 2D, 3D, others), within a
/// category by the rate of the baseline, smallest first.
struct Batch {
  std::vector<RunSummary> runs;
  std::vector<std::string> schemes;     ///< of all runs, by group, in the order they first appear
  std::vector<std::string> categories;  ///< in the page's order; "" = none named
  std::string baseline;                 ///< dcp or the first scheme; empty without schemes
  CostConstants energy;

  /// Rates of one scheme in one category: `rate` if with_bursts, else `rate_payload`. Leaves out runs without
  /// the scheme.
  std::vector<double> rates(const std::string& category, const std::string& scheme, bool with_bursts) const;
  /// Index of a scheme in `schemes`, which is its colour; `otherwise` if there is no such scheme.
  size_t color_of(const std::string& scheme, size_t otherwise = 0) const;
  /// Heading of a run's rows in a chart; empty if all runs have one category.
  std::string group_of(const RunSummary& run) const;
};

/// Sorts the runs and fills schemes, categories and baseline.
void arrange_batch(Batch& batch);

/// Label of a category: "UI", or "no category" for "".
std::string category_label(const std::string& category);
struct Section {
  std::string heading{};
  std::string note{};   ///< HTML
  std::string chart{};  ///< HTML; empty: no chart
  Table table{};        ///< the chart's figures; its name is the section's id
  bool folded = false;  ///< a table without a chart is folded
};
std::string section_html(const Section& section);
/// The link to a section at the top of the page.
std::string section_link(const std::string& id, const std::string& heading);

/// The section with one part per run.
std::string run_parts(const Batch& batch);

}  // namespace tilepress
