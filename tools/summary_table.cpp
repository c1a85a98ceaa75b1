// Summary table: sums over the frames that are not warmup.
#include "summary_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "tilepress/cost_model.h"

namespace tilepress {
namespace {

double percent(uint64_t part, uint64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

/// "720x1280 RGBA8", or the number of surfaces if there are several shapes.
std::string shape_text(const std::vector<FrameStatistics>& frames) {
  if (frames.empty()) return {};
  const FrameStatistics& first = frames.front();
  uint32_t last_surface = 0;
  bool uniform = true;
  for (const FrameStatistics& frame : frames) {
    last_surface = std::max(last_surface, frame.surface);
    uniform &= frame.width == first.width && frame.height == first.height && frame.format == first.format;
  }
  if (!uniform) return fmt::format(", {} surfaces", last_surface + 1);
  return fmt::format(", {}x{} {}", first.width, first.height, traits(first.format).name);
}

}  // namespace

std::string summary_table(const RunRecord& run, const std::string& title) {
  const RunCounts& counts = run.counts;
  std::string out = fmt::format("{}: {} frames seen, {} captured{}", title, counts.seen, counts.captured,
                                shape_text(run.frames));
  if (counts.skipped > 0) out += fmt::format(", {} not asked for", counts.skipped);
  if (counts.dropped > 0) out += fmt::format(", {} dropped (queue full)", counts.dropped);
  if (counts.unsupported > 0) out += fmt::format(", {} in an unsupported format", counts.unsupported);
  if (counts.not_captured > 0) out += fmt::format(", {} could not be read back", counts.not_captured);
  out += '\n';
  if (run.measured_frames == 0) {
    if (counts.captured > 0)
      out +=
          "  no rates: frame 0 of a surface is warm-up and stays out of every sum; it takes a second frame\n";
    return out;
  }
  size_t width = 6;
  for (const std::string& name : run.scheme_names) width = std::max(width, name.size());
  out += fmt::format("  {:<{}}  {:>9}  {:>12}  {:>8}  {:>7}  {:>9}  {:>8}\n", "scheme", width, "rate",
                     "rate_payload", "bursts", "csb", "palette", "saving");
  uint64_t checked = 0, mismatched = 0;
  for (size_t i = 0; i < run.scheme_names.size(); ++i) {
    const SchemeStatistics& sum = run.totals[i];
    const uint64_t moved = sum.moved_bits();
    out +=
        fmt::format("  {:<{}}  {:>9.4f}  {:>12.4f}  {:>6.2f} %  {:>5.2f} %  {:>7.3f} %  {:>6.1f} %\n",
                    run.scheme_names[i], width, sum.rate(), sum.rate_payload(),
                    percent(sum.bursts * sum.burst_bits, moved), percent(sum.csb_bits, moved),
                    percent(sum.palette_bits, moved), sum.rate() > 0 ? 100 * energy_saving(sum.rate()) : 0.0);
    checked += sum.checked_blocks;
    mismatched += sum.mismatched_blocks;
  }
  for (size_t i = 0; i < run.scheme_names.size(); ++i)
    if (const SchemeStatistics& sum = run.totals[i]; sum.extra_bits > 0)
      out += fmt::format("  {}: rate {:.4f} with the further traffic it causes\n", run.scheme_names[i],
                         sum.rate_with_extra());
  if (checked > 0)
    out +=
        fmt::format("  verified: {} blocks encoded, decoded and compared, {} differ\n", checked, mismatched);
  return out;
}

}  // namespace tilepress
