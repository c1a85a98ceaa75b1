// Run summary: sums, means and the line charts of each surface.
#include "run_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>

#include "cdf_plot.h"
#include "html_text.h"
#include "page_parts.h"
#include "run_batch.h"

namespace tilepress {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr size_t kMinPoints = 100, kMaxPoints = 2400;

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) {
    out += out.empty() ? "" : " ";
    out += word;
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> facts_of(const RunRecord& run) {
  const RunCounts& counts = run.counts;
  std::vector<std::pair<std::string, std::string>> facts = {
      {"folder", run.path},
      {"state", run.state + (run.reason.empty() ? "" : ": " + run.reason)},
      {"started", run.started},
      {"command", joined(run.info.command)},
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
  MeanMetrics sum{0, 0, 0, 0, 0, 0, 0};
  double count = 0;
  for (const FrameStatistics& frame : frames) {
    if (frame.warmup) continue;
    ++count;
    sum.unique_colors += static_cast<double>(frame.metrics.unique_colors);
    sum.entropy += frame.metrics.entropy;
    sum.pixel_change += frame.metrics.pixel_change;
    sum.color_change += frame.metrics.color_change;
    sum.fvc_coverage += frame.metrics.fvc_coverage;
    sum.fvc_relative_coverage += frame.metrics.fvc_relative_coverage;
    sum.top100_coverage += frame.metrics.top100_coverage;
  }
  if (count == 0) return {};
  return {sum.unique_colors / count,  sum.entropy / count,      sum.pixel_change / count,
          sum.color_change / count,   sum.fvc_coverage / count, sum.fvc_relative_coverage / count,
          sum.top100_coverage / count};
}

std::string reduction_note(size_t width) {
  if (width == 1) return "";
  return fmt::format(
      " Drawn from the smallest and the largest value of every {} frames; all figures in the tables come "
      "from every frame.",
      width);
}

SurfacePlots plots_of(const RunRecord& run, const std::string& slug,
                      const std::vector<const FrameStatistics*>& frames, size_t max_points) {
  SurfacePlots out;
  const FrameStatistics& first = *frames.front();
  out.label = fmt::format("surface {}, {}×{} {}, {} frames", first.surface, first.width, first.height,
                          traits(first.format).name, frames.size());
  LinePlot rate{.id = "rate",
                .title = "Rate over frames",
                .x_name = "frame",
                .x_unit = "frame number",
                .y_unit = "rate: raw bits / moved bits",
                .file = fmt::format("{}-surface{}-rate.csv", slug, first.surface)};
  for (size_t i = 0; i < run.scheme_names.size(); ++i) rate.lines.push_back({run.scheme_names[i], i, {}});
  LinePlot change{.id = "change",
                  .title = "Pixel and colour change over time",
                  .x_name = "frame",
                  .x_unit = "frame number",
                  .y_unit = "share of pixels",
                  .file = fmt::format("{}-surface{}-change.csv", slug, first.surface),
                  .y_max = 1};
  change.lines = {{"pixel_change", 0, {}}, {"color_change", 1, {}}};
  LinePlot colors{.id = "coverage",
                  .title = "Colours over time",
                  .x_name = "frame",
                  .x_unit = "frame number",
                  .y_unit = "share of pixels",
                  .file = fmt::format("{}-surface{}-coverage.csv", slug, first.surface),
                  .y_max = 1};
  colors.lines = {{"fvc_coverage", 2, {}}, {"fvc_relative_coverage", 3, {}}, {"top100_coverage", 4, {}}};
  for (const FrameStatistics* frame : frames) {
    // The warm-up frame has no CCD and nothing before it to differ from.
    if (frame->warmup) continue;
    const double x = static_cast<double>(frame->frame);
    rate.x.push_back(x);
    for (size_t i = 0; i < rate.lines.size(); ++i) {
      const bool known = i < frame->schemes.size() && frame->schemes[i].raw_bits > 0;
      rate.lines[i].y.push_back(known ? frame->schemes[i].rate() : kNone);
    }
    change.x.push_back(x);
    change.lines[0].y.push_back(frame->metrics.pixel_change);
    change.lines[1].y.push_back(frame->metrics.color_change);
    colors.x.push_back(x);
    colors.lines[0].y.push_back(frame->metrics.fvc_coverage);
    colors.lines[1].y.push_back(frame->metrics.fvc_relative_coverage);
    colors.lines[2].y.push_back(frame->metrics.top100_coverage);
  }
  if (rate.x.empty()) return out;
  rate.note = "Column rate of schemes.csv; higher is better. The warm-up frame is left out." +
              reduction_note(reduce_line_plot(rate, max_points));
  change.note =
      "Share of positions whose value differs from the frame before, and half the sum of the differences of "
      "the colour counts." +
      reduction_note(reduce_line_plot(change, max_points));
  colors.note =
      "Share of pixels counted in the FVC, its ratio to the equally many most frequent colours, and the "
      "share of the 100 most frequent colours." +
      reduction_note(reduce_line_plot(colors, max_points));
  out.plots = {std::move(rate), std::move(change), std::move(colors)};
  return out;
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
  out.path = run.path;
  out.name = name;
  out.category = workload_category(run);
  out.state = run.state;
  out.facts = facts_of(run);
  out.frames = run.frames.size();
  out.measured = run.measured_frames;
  out.schemes = run.scheme_names;
  out.totals = run.totals;
  out.means = means_of(run.frames);
  for (size_t i = 0; i < out.schemes.size(); ++i)
    if (out.vdcp_blocks + out.ras_blocks == 0 && scheme_family(out.schemes[i]) == "hybrid") {
      out.vdcp_blocks = out.totals[i].own[0];
      out.ras_blocks = out.totals[i].own[1];
    }

  std::map<uint32_t, std::vector<const FrameStatistics*>> surfaces;
  for (const FrameStatistics& frame : run.frames) surfaces[frame.surface].push_back(&frame);
  const size_t lines = std::max<size_t>(1, surfaces.size() * (run.scheme_names.size() + 8));
  const size_t max_points = std::clamp(point_budget / lines, kMinPoints, kMaxPoints);
  for (const auto& [surface, frames] : surfaces)
    out.surfaces.push_back(plots_of(run, file_slug(name), frames, max_points));
  for (CdfPlot& cdf : load_cdf_plots(run.path, file_slug(name))) {
    const auto place = surfaces.find(cdf.surface);
    if (place == surfaces.end()) continue;
    const auto position = static_cast<size_t>(std::distance(surfaces.begin(), place));
    out.surfaces[position].plots.push_back(std::move(cdf.plot));
  }
  return out;
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
