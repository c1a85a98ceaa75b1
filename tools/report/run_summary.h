// Run summary: what the report keeps of one run.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "run_pictures.h"
#include "surface_plots.h"
#include "tilepress/run_reader.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// Means over the measured frames of a run; NaN if there are none.
struct MeanMetrics {
  double unique_colors = 0, entropy = 0, pixel_change = 0, color_change = 0, fvc_coverage = 0;
};

struct RunSummary {
  std::string name;                                        ///< workload
  std::string category;                                    ///< empty if run.json names none
  std::vector<std::pair<std::string, std::string>> facts;  ///< what run.json says, for people
  uint64_t frames = 0;                                     ///< rows of frames.csv
  uint64_t measured = 0;                                   ///< of these, not warm-up
  MeanMetrics means;
  std::vector<std::string> schemes;
  std::vector<SchemeStatistics> totals;  ///< over the measured frames, in the order of schemes
  std::vector<SurfacePlots> surfaces;
  std::vector<RunPicture> pictures;

  /// Position of a scheme by its full text, or schemes.size().
  size_t find(const std::string& scheme) const;
  /// NaN if the run has no such scheme or no measured frame.
  double rate(const std::string& scheme) const;
  double rate_payload(const std::string& scheme) const;
};

/// Adds up the run. `point_budget`: the most values in all its line charts together.
RunSummary summarise_run(const RunRecord& run, const std::string& name, size_t point_budget);

/// Precondition: there are values.
double median(std::vector<double> values);

/// Count / Σ (1 / value). Skips values that are NaN or not positive. NaN if no value is left.
double harmonic_mean(const std::vector<double>& values);

}  // namespace tilepress
