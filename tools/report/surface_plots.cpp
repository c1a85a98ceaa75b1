// Surface plots: one line per scheme or metric.
#include "surface_plots.h"

#include <fmt/format.h>

#include <cmath>

#include "counted.h"

namespace tilepress {
namespace {

using Frames = std::vector<const FrameStatistics*>;

/// A metric that is a share of pixels, and its line's colour.
struct ShareLine {
  const char* name;
  size_t color_index;
  double FrameMetrics::*value;
};
constexpr ShareLine kChanges[] = {{"pixel_change", 0, &FrameMetrics::pixel_change},
                                  {"color_change", 1, &FrameMetrics::color_change}};
constexpr ShareLine kColors[] = {{"fvc_coverage", 2, &FrameMetrics::fvc_coverage},
                                 {"fvc_relative_coverage", 3, &FrameMetrics::fvc_relative_coverage},
                                 {"top100_coverage", 4, &FrameMetrics::top100_coverage}};

/// A plot over the measured frames. The warm-up frame has no CCD and no frame before it.
LinePlot empty_plot(const std::string& id, const std::string& title, const std::string& file_start,
                    const Frames& frames) {
  LinePlot plot{.id = id, .title = title, .x_name = "frame", .x_unit = "frame number"};
  plot.file = file_start + "-" + id + ".csv";
  for (const FrameStatistics* frame : frames)
    if (!frame->warmup) plot.x.push_back(static_cast<double>(frame->frame));
  return plot;
}

LinePlot rate_plot(const RunRecord& run, const std::string& file_start, const Frames& frames) {
  LinePlot plot = empty_plot("rate", "Rate over frames", file_start, frames);
  plot.y_unit = "rate: raw bits / moved bits";
  plot.note = "Column rate of schemes.csv; higher is better. The warm-up frame is left out.";
  for (size_t i = 0; i < run.scheme_names.size(); ++i) {
    PlotLine& line = plot.lines.emplace_back(PlotLine{run.scheme_names[i], i, {}});
    for (const FrameStatistics* frame : frames) {
      if (frame->warmup) continue;
      const bool known = i < frame->schemes.size() && frame->schemes[i].raw_bits > 0;
      line.y.push_back(known ? frame->schemes[i].rate() : NAN);
    }
  }
  return plot;
}

template <size_t N>
LinePlot share_plot(LinePlot plot, const ShareLine (&lines)[N], const std::string& note,
                    const Frames& frames) {
  plot.y_unit = "share of pixels";
  plot.y_max = 1;
  plot.note = note;
  for (const ShareLine& share : lines) {
    PlotLine& line = plot.lines.emplace_back(PlotLine{share.name, share.color_index, {}});
    for (const FrameStatistics* frame : frames)
      if (!frame->warmup) line.y.push_back(frame->metrics.*share.value);
  }
  return plot;
}

}  // namespace

SurfacePlots plot_surface(const RunRecord& run, const std::string& slug, const Frames& frames,
                          size_t max_points) {
  const FrameStatistics& first = *frames.front();
  SurfacePlots out;
  out.label = fmt::format("surface {}, {}×{} {}, {}", first.surface, first.width, first.height,
                          traits(first.format).name, counted(frames.size(), "frame"));
  const std::string file_start = fmt::format("{}-surface{}", slug, first.surface);
  LinePlot rates = rate_plot(run, file_start, frames);
  if (rates.x.empty()) return out;
  out.plots = {
      std::move(rates),
      share_plot(empty_plot("change", "Pixel and colour change over time", file_start, frames), kChanges,
                 "pixel_change: share of positions whose value differs from the frame before. "
                 "color_change: half the sum of the differences of the colour counts.",
                 frames),
      share_plot(empty_plot("coverage", "Colours over time", file_start, frames), kColors,
                 "fvc_coverage: share of pixels that the FVC counts. fvc_relative_coverage: its ratio to "
                 "the share of the same number of most frequent colours. top100_coverage: share of the "
                 "100 most frequent colours.",
                 frames)};
  for (LinePlot& plot : out.plots) {
    const size_t width = reduce_line_plot(plot, max_points);
    if (width > 1)
      plot.note += fmt::format(
          " The chart shows the smallest and the largest value of every {} frames. The tables count every "
          "frame.",
          width);
  }
  return out;
}

}  // namespace tilepress
