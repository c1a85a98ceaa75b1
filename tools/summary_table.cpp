// Summary table: sums over the frames that are not warm-up.
#include "summary_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "counted.h"
#include "report/scheme_names.h"

namespace tilepress {
namespace {

double percent(uint64_t part, uint64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

/// "720x1280 RGBA8", or the number of surfaces if there are several shapes.
std::string shape_text(const std::vector<FrameStatistics>& frames) {
  const auto presented = std::find_if(frames.begin(), frames.end(),
                                      [](const FrameStatistics& frame) { return !is_target(frame.surface); });
  if (presented == frames.end()) return {};
  const FrameStatistics& first = *presented;
  uint32_t last_surface = 0;
  bool uniform = true;
  for (const FrameStatistics& frame : frames) {
    if (is_target(frame.surface)) continue;
    last_surface = std::max(last_surface, frame.surface);
    uniform &= frame.width == first.width && frame.height == first.height && frame.format == first.format;
  }
  if (!uniform) return ", " + counted(last_surface + 1, "surface");
  return fmt::format(", {}x{} {}", first.width, first.height, traits(first.format).name);
}

/// Counts of the frames that have no rows.
std::string shortfall_text(const RunCounts& counts) {
  std::string out;
  if (counts.skipped > 0) out += fmt::format(", {} left out by --frames and --every", counts.skipped);
  if (counts.dropped > 0) out += fmt::format(", {} dropped (queue full)", counts.dropped);
  if (counts.unsupported > 0) out += fmt::format(", {} in an unsupported format", counts.unsupported);
  if (counts.not_captured > 0) out += fmt::format(", {} could not be read back", counts.not_captured);
  return out + '\n';
}

/// One line per scheme.
std::string rates_text(const std::vector<std::string>& names, const std::vector<SchemeStatistics>& totals) {
  size_t width = 6;
  for (const std::string& name : names) width = std::max(width, name.size());
  std::string out = fmt::format("  {:<{}}  {:>9}  {:>12}  {:>8}  {:>7}  {:>9}  {:>8}\n", "scheme", width,
                                "rate", "payload rate", "bursts", "csb", "palette", "saving");
  for (size_t i = 0; i < names.size(); ++i) {
    const SchemeStatistics& sum = totals[i];
    const uint64_t moved = sum.moved_bits();
    if (sum.blocks == 0) {  // the scheme supports the format of no surface
      out += fmt::format("  {:<{}}  {:>9}  {:>12}  {:>8}  {:>7}  {:>9}  {:>8}\n", names[i], width, "-", "-", "-", "-",
                         "-", "-");
      continue;
    }
    const auto saving = scheme_saving(names[i], sum.rate());
    out += fmt::format("  {:<{}}  {:>9.4f}  {:>12.4f}  {:>6.2f} %  {:>5.2f} %  {:>7.3f} %  {:>8}\n", names[i],
                       width, sum.rate(), sum.rate_payload(), percent(sum.bursts * sum.burst_bits, moved),
                       percent(sum.csb_bits, moved), percent(sum.palette_bits, moved),
                       saving ? fmt::format("{:.1f} %", 100 * *saving) : "-");
  }
  if (std::ranges::any_of(names, has_other_entries))
    out += "  saving: the energy of DCP's structures is that of 64 entries for every size\n";
  for (size_t i = 0; i < names.size(); ++i)
    if (const SchemeStatistics& sum = totals[i]; sum.extra_bits > 0)
      out += fmt::format("  {}: rate {:.4f} with the further traffic it causes\n", names[i],
                         sum.rate_with_extra());
  return out;
}

/// The images of the program's own framebuffers (--targets all).
std::string targets_text(const RunRecord& run) {
  const RunCounts& counts = run.target_counts;
  if (counts.seen == 0) return {};
  std::set<uint32_t> surfaces;
  for (const FrameStatistics& frame : run.frames)
    if (is_target(frame.surface)) surfaces.insert(frame.surface);
  std::string out = fmt::format("  render targets: {} of {} captured{}", counted(counts.captured, "frame"),
                                counted(surfaces.size(), "surface"), shortfall_text(counts));
  if (run.measured_targets > 0) out += rates_text(run.scheme_names, run.target_totals);
  return out;
}

}  // namespace

std::string summary_table(const RunRecord& run, const std::string& title) {
  const RunCounts& counts = run.counts;
  std::string out = fmt::format("{}: {} seen, {} captured{}{}", title, counted(counts.seen, "frame"), counts.captured,
                                shape_text(run.frames), shortfall_text(counts));
  if (run.measured_frames == 0) {
    if (counts.captured > 0)
      out +=
          "  no rates: frame 0 of a surface is warm-up and no sum counts it; rates need a second frame\n";
    return out + targets_text(run);
  }
  out += rates_text(run.scheme_names, run.totals) + targets_text(run);
  uint64_t checked = 0, mismatched = 0;
  for (const std::vector<SchemeStatistics>* totals : {&run.totals, &run.target_totals})
    for (const SchemeStatistics& sum : *totals) {
      checked += sum.checked_blocks;
      mismatched += sum.mismatched_blocks;
    }
  if (checked > 0)
    out +=
        fmt::format("  verified: {} encoded, decoded and compared, {} differ\n", counted(checked, "block"), mismatched);
  return out;
}

}  // namespace tilepress
