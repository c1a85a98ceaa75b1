// CDF plot: one pass over cdf.csv, keeping the cells at the chosen ranks.
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

/// True for the ranks that are drawn: 1 … 10, then each at least a tenth above the one before.
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

}  // namespace

std::vector<CdfPlot> load_cdf_plots(const std::string& run_path, const std::string& slug) {
  std::ifstream file(run_path + "/cdf.csv", std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  CsvRecords records(text);
  const CsvRowReader<ColorCdfRow> reader(records, color_cdf_columns());
  std::map<uint32_t, std::map<uint64_t, Curve>> surfaces;
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

  std::vector<CdfPlot> out;
  for (const auto& [number_of, frames] : surfaces) {
    std::vector<uint64_t> numbers;
    for (const auto& [key, value] : frames) numbers.push_back(key);
    const size_t count = std::min(kMaxLines, numbers.size());
    CdfPlot cdf;
    cdf.surface = number_of;
    LinePlot& plot = cdf.plot;
    plot.id = "cdf";
    plot.title = "Colour CDF";
    plot.note =
        "Share of the frame's pixels in its most frequent colours, by how many colours. Ranks are thinned "
        "out; every point is a row of cdf.csv.";
    plot.x_name = "rank";
    plot.x_unit = "number of colours, most frequent first, logarithmic";
    plot.y_unit = "share of pixels";
    plot.file = slug + "-surface" + std::to_string(number_of) + "-cdf.csv";
    plot.x_log = true;
    plot.y_max = 1;
    std::set<uint64_t> ranks;
    std::vector<const Curve*> curves;
    for (size_t i = 0; i < count; ++i) {
      const uint64_t key = numbers[count == 1 ? 0 : i * (numbers.size() - 1) / (count - 1)];
      plot.lines.push_back({"frame " + std::to_string(key), i, {}});
      curves.push_back(&frames.at(key));
      for (const auto& [at, value] : *curves.back()) ranks.insert(at);
    }
    for (const uint64_t at : ranks) {
      plot.x.push_back(static_cast<double>(at));
      for (size_t i = 0; i < curves.size(); ++i) {
        const auto cell = curves[i]->find(at);
        plot.lines[i].y.push_back(cell == curves[i]->end() ? NAN : cell->second);
      }
    }
    out.push_back(std::move(cdf));
  }
  return out;
}

}  // namespace tilepress
