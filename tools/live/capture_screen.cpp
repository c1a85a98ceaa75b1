// Capture screen: the texts, and nothing about terminals.
#include "live/capture_screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepress {
namespace {

constexpr size_t kBarColumns = 24;
constexpr double kBarRate = 8;  ///< rate of a full bar

double ratio(uint64_t raw, uint64_t moved) {
  return moved > 0 ? static_cast<double>(raw) / static_cast<double>(moved) : NAN;
}

std::string rate_text(double rate) {
  return std::isnan(rate) ? "     -" : fmt::format("{:6.3f}", rate);
}

std::string bar_of(double rate) {
  const double share = std::isnan(rate) ? 0 : std::clamp(rate / kBarRate, 0.0, 1.0);
  const size_t full = static_cast<size_t>(std::lround(share * kBarColumns));
  return std::string(full, '#') + std::string(kBarColumns - full, '.');
}

double milliseconds(uint64_t sum_ns, uint64_t count) {
  return count > 0 ? static_cast<double>(sum_ns) / static_cast<double>(count) * 1e-6 : 0;
}

}  // namespace

std::string printable_name(const char (&name)[kLiveNameBytes]) {
  std::string out;
  for (size_t i = 0; i < sizeof name && name[i] != 0; ++i)
    out += name[i] >= 0x20 && name[i] < 0x7F ? name[i] : '?';
  return out;
}

double frames_per_second(const WatchedCapture& capture) {
  if (capture.elapsed_s <= 0 || capture.now.captured < capture.before.captured) return NAN;
  return static_cast<double>(capture.now.captured - capture.before.captured) / capture.elapsed_s;
}

std::vector<std::string> capture_lines(const WatchedCapture& capture, size_t columns) {
  const LiveState& now = capture.now;
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{} ({})  {}x{}  frame {} of surface {}{}", printable_name(now.program),
                              now.pid, now.width, now.height, now.frame, now.surface,
                              capture.ended ? "  ended" : ""));
  const double rate = frames_per_second(capture);
  lines.push_back(fmt::format("  {} frames/s  seen {}  captured {}  dropped {}  skipped {}  unsupported {}",
                              std::isnan(rate) ? "-" : fmt::format("{:.1f}", rate), now.seen, now.captured,
                              now.dropped, now.skipped, now.unsupported + now.not_captured));
  // Costs of the time between the snapshots; of the whole run where nothing came in between.
  const bool fresh = now.captured > capture.before.captured && capture.elapsed_s > 0;
  const uint64_t count = fresh ? now.captured - capture.before.captured : now.captured;
  lines.push_back(fmt::format(
      "  FVC coverage {:.1f} %  pixel change {:.1f} %  queue {}/{}  readback {:.2f} ms  compress {:.2f} ms",
      now.fvc_coverage * 100, now.pixel_change * 100, now.queued, now.queue_depth,
      milliseconds(now.readback_sum_ns - (fresh ? capture.before.readback_sum_ns : 0), count),
      milliseconds(now.encode_sum_ns - (fresh ? capture.before.encode_sum_ns : 0), count)));
  size_t width = 8;
  for (size_t i = 0; i < now.scheme_count; ++i)
    width = std::max(width, printable_name(now.schemes[i].name).size());
  lines.push_back(fmt::format("  {:<{}}  {:>6}  {:>6}", "scheme", width, "run", "frame"));
  for (size_t i = 0; i < now.scheme_count; ++i) {
    const LiveScheme& scheme = now.schemes[i];
    const double of_run = ratio(scheme.raw_bits, scheme.moved_bits);
    lines.push_back(fmt::format("  {:<{}}  {}  {}  {}", printable_name(scheme.name), width, rate_text(of_run),
                                rate_text(ratio(scheme.frame_raw_bits, scheme.frame_moved_bits)),
                                bar_of(of_run)));
  }
  for (std::string& line : lines)
    if (line.size() > columns) line.resize(columns);
  return lines;
}

}  // namespace tilepress
