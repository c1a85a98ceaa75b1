// Surface plots: a line per scheme, metric or frame. cdf.csv is read once, for the drawn ranks only.
#include "surface_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "counted.h"
#include "html_text.h"
#include "tilepress/color_cdf.h"
#include "tilepress/csv_rows.h"
#include "tilepress/whole_file.h"

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

constexpr size_t kMaxLines = 6;

/// Chooses the ranks to draw: 1 … 10, then each at least a tenth above the one before.
class RankChoice {
 public:
  bool drawn(uint64_t rank) {
    while (ranks_.back() < rank) ranks_.push_back(ranks_.back() + std::max<uint64_t>(1, ranks_.back() / 10));
    return std::binary_search(ranks_.begin(), ranks_.end(), rank);
  }

 private:
  std::vector<uint64_t> ranks_{1};
};

/// Cumulative share by rank of one frame; its last rank is always there.
using Curve = std::map<uint64_t, double>;
/// The curves of one surface by frame.
using Curves = std::map<uint64_t, Curve>;

/// Reads the drawn ranks of every frame, by surface. Empty without the file, or for a file of another kind.
std::map<uint32_t, Curves> read_curves(const std::string& path) {
  const auto text = read_whole_file(path);
  if (!text) return {};
  CsvRecords records(*text);
  const CsvRowReader<ColorCdfRow> reader(records, color_cdf_columns());
  std::map<uint32_t, Curves> surfaces;
  RankChoice choice;
  ColorCdfRow row, last;
  Curve* curve = nullptr;
  while (records.next()) {
    if (!reader.read(row)) return {};
    if (row.rank == 1) {
      if (curve != nullptr) (*curve)[last.rank] = last.cumulative;
      curve = &surfaces[row.surface][row.frame];
    }
    if (curve == nullptr) return {};
    if (choice.drawn(row.rank)) (*curve)[row.rank] = row.cumulative;
    last = row;
  }
  if (curve != nullptr) (*curve)[last.rank] = last.cumulative;
  return surfaces;
}

LinePlot cdf_plot_of(const Curves& frames) {
  LinePlot plot{.id = "cdf", .title = "Colour CDF"};
  plot.note =
      "Share of the frame's pixels that its most frequent colours cover, by the number of colours. Each "
      "point is a row of cdf.csv; most ranks are left out.";
  plot.x_name = "rank";
  plot.x_unit = "number of colours, most frequent first, logarithmic";
  plot.y_unit = "share of pixels";
  plot.x_log = true;
  plot.y_max = 1;
  const size_t count = std::min(kMaxLines, frames.size());
  std::set<uint64_t> ranks;
  std::vector<const Curve*> curves;
  for (size_t i = 0; i < count; ++i) {
    const size_t position = count == 1 ? 0 : i * (frames.size() - 1) / (count - 1);
    const auto& [frame, curve] = *std::next(frames.begin(), static_cast<std::ptrdiff_t>(position));
    plot.lines.push_back({"frame " + std::to_string(frame), i, {}});
    curves.push_back(&curve);
    for (const auto& [rank, share] : curve) ranks.insert(rank);
  }
  for (const uint64_t rank : ranks) {
    plot.x.push_back(static_cast<double>(rank));
    for (size_t i = 0; i < curves.size(); ++i) {
      const auto cell = curves[i]->find(rank);
      plot.lines[i].y.push_back(cell == curves[i]->end() ? NAN : cell->second);
    }
  }
  return plot;
}

}  // namespace

std::string surfaces_json(const std::vector<SurfacePlots>& surfaces) {
  std::string out = "[";
  for (const SurfacePlots& surface : surfaces) {
    if (surface.plots.empty()) continue;
    out += fmt::format("{}{{\"label\":\"{}\",\"plots\":[", out.size() > 1 ? "," : "",
                       escape_json(surface.label));
    for (size_t i = 0; i < surface.plots.size(); ++i)
      out.append(i > 0 ? "," : "").append(line_plot_json(surface.plots[i]));
    out += "]}";
  }
  return out + "]";
}

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

std::vector<CdfPlot> load_cdf_plots(const std::string& run_path, const std::string& slug) {
  std::vector<CdfPlot> out;
  for (const auto& [surface, frames] : read_curves(run_path + "/cdf.csv")) {
    CdfPlot& cdf = out.emplace_back(CdfPlot{surface, cdf_plot_of(frames)});
    cdf.plot.file = slug + "-surface" + std::to_string(surface) + "-cdf.csv";
  }
  return out;
}

}  // namespace tilepress
