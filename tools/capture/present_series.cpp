// Present series: the rows of .times files as intervals.
#include "capture/present_series.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>

#include "tilepress/csv_rows.h"
#include "tilepress/present_rows.h"

namespace tilepress {
namespace {

/// Presents before the first interval that counts: the shim loads its engine in the first.
constexpr size_t kStartUpFrames = 2;

using Presents = std::vector<PresentTimeRow>;

std::map<uint64_t, Presents> presents_by_window(const std::filesystem::path& path) {
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::map<uint64_t, Presents> windows;
  CsvRecords records(text);
  const CsvRowReader<PresentTimeRow> reader(records, present_time_columns());
  while (records.next())
    if (PresentTimeRow row; reader.read(row)) windows[row.window].push_back(row);
  return windows;
}

PresentSeries series_of(const Presents& presents) {
  PresentSeries series;
  series.presents = presents.size();
  double hook_sum_ns = 0;
  for (size_t i = kStartUpFrames; i < presents.size(); ++i) {
    series.intervals_ns.push_back(static_cast<double>(presents[i].begin_ns - presents[i - 1].begin_ns));
    hook_sum_ns += static_cast<double>(presents[i - 1].hook_ns);
  }
  if (!series.intervals_ns.empty())
    series.hook_ns = hook_sum_ns / static_cast<double>(series.intervals_ns.size());
  std::sort(series.intervals_ns.begin(), series.intervals_ns.end());
  return series;
}

}  // namespace

double PresentSeries::mean_ns() const {
  if (intervals_ns.empty()) return 0;
  return std::accumulate(intervals_ns.begin(), intervals_ns.end(), 0.0) /
         static_cast<double>(intervals_ns.size());
}

double PresentSeries::quantile_ns(double part) const {
  if (intervals_ns.empty()) return 0;
  const double rank = std::ceil(part * static_cast<double>(intervals_ns.size()));
  return intervals_ns[static_cast<size_t>(std::max(rank, 1.0)) - 1];
}

PresentSeries busiest_series(const std::string& folder) {
  Presents busiest;
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator(folder, code)) {
    if (entry.path().extension() != ".times") continue;
    for (auto& [window, presents] : presents_by_window(entry.path()))
      if (presents.size() > busiest.size()) busiest = std::move(presents);
  }
  return series_of(busiest);
}

}  // namespace tilepress
