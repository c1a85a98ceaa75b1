// Run summary: sums and means of one run.
#include "run_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>

#include "html_text.h"
#include "run_batch.h"

namespace tilepress {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr size_t kMinPoints = 100, kMaxPoints = 2400;

std::vector<std::pair<std::string, std::string>> facts_of(const RunRecord& run) {
  const RunCounts& counts = run.counts;
  std::vector<std::pair<std::string, std::string>> facts = {
      {"folder", run.path},
      {"state", run.state + (run.reason.empty() ? "" : ": " + run.reason)},
      {"started", run.started},
      {"command", fmt::format("{}", fmt::join(run.info.command, " "))},
      {"captured through", run.info.via + (run.info.api.empty() ? "" : ", " + run.info.api)},
      {"GL", run.info.gl_renderer + (run.info.gl_version.empty() ? "" : ", " + run.info.gl_version)},
      {"GL vendor", run.info.gl_vendor}};
  if (counts.seen > 0)
    facts.emplace_back(
        "frames", fmt::format("{} seen, {} captured, {} dropped, {} skipped, {} unsupported, {} not captured",
                              counts.seen, counts.captured, counts.dropped, counts.skipped,
                              counts.unsupported, counts.not_captured));
  facts.emplace_back("burst", fmt::format("{} bits", run.burst_bits));
  for (const auto& [name, value] : run.info.further) facts.emplace_back(name, value);
  std::erase_if(facts, [](const auto& fact) { return fact.second.empty(); });
  return facts;
}

MeanMetrics means_of(const std::vector<FrameStatistics>& frames) {
  MeanMetrics sum{};
  double count = 0;
  for (const FrameStatistics& frame : frames) {
    if (frame.warmup) continue;
    ++count;
    sum.unique_colors += static_cast<double>(frame.metrics.unique_colors);
    sum.entropy += frame.metrics.entropy;
    sum.pixel_change += frame.metrics.pixel_change;
    sum.color_change += frame.metrics.color_change;
    sum.fvc_coverage += frame.metrics.fvc_coverage;
  }
  // Without a measured frame every mean is 0/0: NaN.
  for (double* mean : {&sum.unique_colors, &sum.entropy, &sum.pixel_change, &sum.color_change, &sum.fvc_coverage})
    *mean /= count;
  return sum;
}

}  // namespace

size_t RunSummary::find(const std::string& scheme) const {
  return static_cast<size_t>(std::find(schemes.begin(), schemes.end(), scheme) - schemes.begin());
}

double RunSummary::rate(const std::string& scheme) const {
  const size_t i = find(scheme);
  return i < totals.size() && totals[i].raw_bits > 0 ? totals[i].rate() : kNone;
}

double RunSummary::rate_payload(const std::string& scheme) const {
  const size_t i = find(scheme);
  return i < totals.size() && totals[i].raw_bits > 0 ? totals[i].rate_payload() : kNone;
}

RunSummary summarise_run(const RunRecord& run, const std::string& name, size_t point_budget) {
  RunSummary out;
  out.name = name;
  out.category = workload_category(run);
  out.facts = facts_of(run);
  out.frames = run.frames.size();
  out.measured = run.measured_frames;
  out.schemes = run.scheme_names;
  out.totals = run.totals;
  out.means = means_of(run.frames);

  std::map<uint32_t, std::vector<const FrameStatistics*>> surfaces;
  for (const FrameStatistics& frame : run.frames) surfaces[frame.surface].push_back(&frame);
  const size_t lines = std::max<size_t>(1, surfaces.size() * (run.scheme_names.size() + 8));
  const size_t max_points = std::clamp(point_budget / lines, kMinPoints, kMaxPoints);
  for (const auto& [surface, frames] : surfaces)
    out.surfaces.push_back(plot_surface(run, file_slug(name), frames, max_points));
  for (CdfPlot& cdf : load_cdf_plots(run.path, file_slug(name))) {
    const auto place = surfaces.find(cdf.surface);
    if (place == surfaces.end()) continue;
    const auto position = static_cast<size_t>(std::distance(surfaces.begin(), place));
    out.surfaces[position].plots.push_back(std::move(cdf.plot));
  }
  return out;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double harmonic_mean(const std::vector<double>& values) {
  double inverse = 0, count = 0;
  for (const double value : values) {
    if (std::isnan(value) || value <= 0) continue;
    inverse += 1 / value;
    ++count;
  }
  return count > 0 ? count / inverse : kNone;
}

}  // namespace tilepress
