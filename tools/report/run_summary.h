// Run summary: what the report keeps of one run once its rows have been added up.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "line_plot.h"
#include "run_pictures.h"
#include "tilepress/run_reader.h"
#include "tilepress/statistics.h"

namespace tilepress {

/// Means over a run's frames that are not warm-up, each frame counting once.
struct MeanMetrics {
  double unique_colors = NAN, entropy = NAN, pixel_change = NAN, color_change = NAN;
  double fvc_coverage = NAN, fvc_relative_coverage = NAN, top100_coverage = NAN;
};

/// The line charts of one surface.
struct SurfacePlots {
  std::string label;  ///< "surface 0, 720×1280 RGBA8, 300 frames"
  std::vector<LinePlot> plots;
};

struct RunSummary {
  std::string path;
  std::string name;      ///< workload
  std::string category;  ///< empty if run.json names none
  std::string state;
  std::vector<std::pair<std::string, std::string>> facts;  ///< what run.json says, for people
  uint64_t frames = 0;                                     ///< rows of frames.csv
  uint64_t measured = 0;                                   ///< of these, not warm-up
  uint64_t vdcp_blocks = 0, ras_blocks = 0;                ///< of the first hdcp scheme
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

/// Adds up the run. `point_budget` bounds the values in all its line charts together.
RunSummary summarise_run(const RunRecord& run, const std::string& name, size_t point_budget);

/// Σ of the inverse / count, inverted; values that are NaN or not positive are left out. NaN if none is left.
double harmonic_mean(const std::vector<double>& values);

}  // namespace tilepress
