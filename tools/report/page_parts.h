// Page parts: the batch a report is about, and the shape that every section of the page has.
#pragma once

#include <string>
#include <vector>

#include "chart_markup.h"
#include "html_text.h"
#include "run_summary.h"

namespace tilepress {

/// Energy constants (paper, Energy savings), in pJ per byte.
struct EnergyModel {
  double dram_pj_per_byte = 451.2;  ///< per byte moved
  double dcp_pj_per_byte = 4.83;    ///< per raw byte, DCP's structures
  /// 1 - 1/rate - dcp/dram.
  double saving(double rate) const { return 1 - 1 / rate - dcp_pj_per_byte / dram_pj_per_byte; }
};

/// Everything a report shows. Runs stand in the paper's order: by category (UI, 2D, 3D, others), in it by the
/// rate of the baseline, smallest first.
struct Batch {
  std::vector<RunSummary> runs;
  std::vector<std::string> schemes;     ///< of all runs, in the order they first appear
  std::vector<std::string> categories;  ///< in the page's order; "" = none named
  std::string baseline;                 ///< scheme the runs are sorted by; empty if there is none
  EnergyModel energy;

  /// Rates of one scheme in one category: with_bursts `rate`, otherwise `rate_payload`. Runs without the
  /// scheme are left out.
  std::vector<double> rates(const std::string& category, const std::string& scheme, bool with_bursts) const;
};

/// Sorts the runs and fills schemes, categories and baseline.
void arrange_batch(Batch& batch);

/// Label of a category: "UI", or "no category" for "".
std::string category_label(const std::string& category);
/// Name of the scheme in front of its options: "vdcp" of "vdcp:fvc=128".
std::string scheme_family(const std::string& scheme);

struct Section {
  std::string id{}, heading{};
  std::string note{};   ///< HTML
  std::string chart{};  ///< HTML; empty = none
  Table table{};        ///< the chart's figures
  bool table_open = false;
};
std::string section_html(const Section& section);

/// Sections about the batch as a whole, in the page's order.
std::vector<Section> batch_sections(const Batch& batch);
/// Sections in which the schemes are compared with each other and the paper.
std::vector<Section> scheme_sections(const Batch& batch);
/// The section with one part per run.
std::string run_parts(const Batch& batch);

}  // namespace tilepress
