// CDF plot: one pass over cdf.csv, which keeps the cells at the drawn ranks.
#include "cdf_plot.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "tilepress/color_cdf.h"
#include "tilepress/csv_rows.h"

namespace tilepress {
namespace {

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
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  CsvRecords records(text);
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

LinePlot plot_of(const Curves& frames) {
  LinePlot plot{.id = "cdf", .title = "Colour CDF"};
  plot.note =
      "Share of the frame's pixels that its most frequent colours cover, by the number of colours. Each point is a "
      "row of cdf.csv; most ranks are left out.";
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

std::vector<CdfPlot> load_cdf_plots(const std::string& run_path, const std::string& slug) {
  std::vector<CdfPlot> out;
  for (const auto& [surface, frames] : read_curves(run_path + "/cdf.csv")) {
    CdfPlot& cdf = out.emplace_back(CdfPlot{surface, plot_of(frames)});
    cdf.plot.file = slug + "-surface" + std::to_string(surface) + "-cdf.csv";
  }
  return out;
}

}  // namespace tilepress
