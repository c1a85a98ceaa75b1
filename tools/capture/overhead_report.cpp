// Overhead report: ratios of means, because the mean determines the frame rate.
#include "capture/overhead_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
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
  std::map<uint64_t, Presents> windows;
  for_each_csv_row<PresentTimeRow>(path, kPresentTimeColumns,
                                   [&](const PresentTimeRow& row) { windows[row.window].push_back(row); });
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

/// The intervals of all runs with, or without, the shim.
PresentSeries side(const std::vector<OverheadRun>& runs, bool captured) {
  PresentSeries all;
  for (const OverheadRun& run : runs) {
    if (run.captured != captured) continue;
    all.presents += run.series.presents;
    all.intervals_ns.insert(all.intervals_ns.end(), run.series.intervals_ns.begin(),
                            run.series.intervals_ns.end());
  }
  std::sort(all.intervals_ns.begin(), all.intervals_ns.end());
  return all;
}

const PresentSeries* without_shim(const std::vector<OverheadRun>& runs, unsigned round) {
  for (const OverheadRun& run : runs)
    if (run.round == round && !run.captured && !run.series.intervals_ns.empty()) return &run.series;
  return nullptr;
}

constexpr const char* side_name(bool captured) {
  return captured ? "with" : "without";
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

std::string overhead_text(const std::vector<OverheadRun>& runs) {
  std::string out = fmt::format("overhead of the shim\n  {:>5}  {:<7}  {:>7}  {:>9}  {:>9}  {:>9}  {:>11}\n",
                                "round", "shim", "frames", "mean ms", "median ms", "95 % ms", "in hook ms");
  double least = 0, most = 0;
  for (const OverheadRun& run : runs) {
    const PresentSeries& times = run.series;
    out += fmt::format("  {:>5}  {:<7}  {:>7}  {:>9.3f}  {:>9.3f}  {:>9.3f}  {:>11.3f}\n", run.round + 1,
                       side_name(run.captured), times.presents, times.mean_ns() / 1e6,
                       times.quantile_ns(0.5) / 1e6, times.quantile_ns(0.95) / 1e6, times.hook_ns / 1e6);
    const PresentSeries* base = run.captured ? without_shim(runs, run.round) : nullptr;
    if (base == nullptr) continue;
    const double ratio = times.mean_ns() / base->mean_ns();
    least = least > 0 ? std::min(least, ratio) : ratio;
    most = std::max(most, ratio);
  }
  const PresentSeries without = side(runs, false), with = side(runs, true);
  if (without.intervals_ns.empty() || with.intervals_ns.empty())
    return out + "  no ratio: it takes three frames with the shim and three without\n";
  return out +
         fmt::format(
             "  frame-time ratio {:.3f} by the mean ({:.3f} to {:.3f} in a round), {:.3f} by the median\n",
             with.mean_ns() / without.mean_ns(), least, most,
             with.quantile_ns(0.5) / without.quantile_ns(0.5));
}

namespace {

struct Row {
  const OverheadRun& run;
  const PresentSeries& times;
  const PresentSeries* base;  ///< the same round without capture; null in rows that have no ratios
};

std::string ratio_text(const Row& row, double with, double (*figure)(const PresentSeries&)) {
  return row.base == nullptr ? "" : fmt::format("{:.6f}", with / figure(*row.base));
}
std::string whole(double ns) {
  return fmt::format("{:.0f}", ns);
}
double mean_of(const PresentSeries& times) {
  return times.mean_ns();
}
double median_of(const PresentSeries& times) {
  return times.quantile_ns(0.5);
}

constexpr CsvColumn<Row> kColumns[] = {
    TILEPRESS_CSV_FIGURE("round", row.run.round + 1),
    TILEPRESS_CSV_FIGURE("shim", side_name(row.run.captured)),
    TILEPRESS_CSV_FIGURE("exit_status", row.run.exit_status),
    TILEPRESS_CSV_FIGURE("frames", row.times.presents),
    TILEPRESS_CSV_FIGURE("mean_ns", whole(mean_of(row.times))),
    TILEPRESS_CSV_FIGURE("median_ns", whole(median_of(row.times))),
    TILEPRESS_CSV_FIGURE("p95_ns", whole(row.times.quantile_ns(0.95))),
    TILEPRESS_CSV_FIGURE("hook_ns", whole(row.times.hook_ns)),
    TILEPRESS_CSV_FIGURE("ratio_mean", ratio_text(row, mean_of(row.times), mean_of)),
    TILEPRESS_CSV_FIGURE("ratio_median", ratio_text(row, median_of(row.times), median_of)),
};

}  // namespace

std::string overhead_csv(const std::vector<OverheadRun>& runs) {
  std::string out = csv_header(kColumns);
  for (const OverheadRun& run : runs) {
    const PresentSeries* base = run.captured ? without_shim(runs, run.round) : nullptr;
    append_csv_row(kColumns, Row{run, run.series, base}, out);
  }
  return out;
}

}  // namespace tilepress
