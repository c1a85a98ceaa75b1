// Overhead report: ratios of means, because the mean determines the frame rate.
#include "capture/overhead_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepress {
namespace {

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

std::string overhead_csv(const std::vector<OverheadRun>& runs) {
  std::string out =
      "round,shim,exit_status,frames,mean_ns,median_ns,p95_ns,hook_ns,ratio_mean,ratio_median\n";
  for (const OverheadRun& run : runs) {
    const PresentSeries& times = run.series;
    out += fmt::format("{},{},{},{},{:.0f},{:.0f},{:.0f},{:.0f}", run.round + 1, side_name(run.captured),
                       run.exit_status, times.presents, times.mean_ns(), times.quantile_ns(0.5),
                       times.quantile_ns(0.95), times.hook_ns);
    const PresentSeries* base = run.captured ? without_shim(runs, run.round) : nullptr;
    if (base != nullptr)
      out += fmt::format(",{:.6f},{:.6f}\n", times.mean_ns() / base->mean_ns(),
                         times.quantile_ns(0.5) / base->quantile_ns(0.5));
    else
      out += ",,\n";
  }
  return out;
}

}  // namespace tilepress
