// Capture screen: texts only; the caller knows the terminal.
#include "live/capture_screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepress {
namespace {

constexpr size_t kBarColumns = 24, kLeastBarColumns = 6;
constexpr double kBarRate = 8;  ///< rate of a full bar

double ratio(uint64_t raw, uint64_t moved) {
  return moved > 0 ? static_cast<double>(raw) / static_cast<double>(moved) : NAN;
}

std::string bar_of(double rate, size_t columns) {
  const double share = std::isnan(rate) ? 0 : std::clamp(rate / kBarRate, 0.0, 1.0);
  const size_t full = static_cast<size_t>(std::lround(share * static_cast<double>(columns)));
  return std::string(full, '#') + std::string(columns - full, '.');
}

/// Puts fields side by side on as many lines as necessary. Lines after the first are indented by two.
void add_wrapped(const std::vector<std::string>& fields, size_t indent, size_t columns,
                 std::vector<std::string>& lines) {
  std::string line(indent, ' ');
  bool empty = true;
  for (const std::string& field : fields) {
    if (!empty && line.size() + 2 + field.size() > columns) {
      lines.push_back(line);
      line.assign(2, ' ');
      empty = true;
    }
    line.append(empty ? "" : "  ").append(field);
    empty = false;
  }
  lines.push_back(line);
}

double milliseconds(uint64_t sum_ns, uint64_t count) {
  return count > 0 ? static_cast<double>(sum_ns) / static_cast<double>(count) * 1e-6 : 0;
}

}  // namespace

std::string rate_text(uint64_t raw_bits, uint64_t moved_bits, int columns) {
  return moved_bits > 0 ? fmt::format("{:{}.3f}", ratio(raw_bits, moved_bits), columns)
                        : fmt::format("{:>{}}", "-", columns);
}

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
  std::vector<std::string> fields = {fmt::format("{} ({})", printable_name(now.program), now.pid),
                                     fmt::format("{}x{}", now.width, now.height),
                                     fmt::format("frame {} of surface {}", now.frame, now.surface)};
  if (capture.ended) fields.push_back("ended");
  add_wrapped(fields, 0, columns, lines);
  const double rate = frames_per_second(capture);
  add_wrapped({fmt::format("{} frames/s", std::isnan(rate) ? "-" : fmt::format("{:.1f}", rate)),
               fmt::format("seen {}", now.seen), fmt::format("captured {}", now.captured),
               fmt::format("dropped {}", now.dropped), fmt::format("skipped {}", now.skipped),
               fmt::format("unsupported {}", now.unsupported + now.not_captured)},
              2, columns, lines);
  // Costs between the snapshots, or of the whole run if no frame came between them.
  const bool fresh = now.captured > capture.before.captured && capture.elapsed_s > 0;
  const uint64_t count = fresh ? now.captured - capture.before.captured : now.captured;
  add_wrapped(
      {fmt::format("FVC coverage {:.1f} %", now.fvc_coverage * 100),
       fmt::format("pixel change {:.1f} %", now.pixel_change * 100),
       fmt::format("queue {}/{}", now.queued, now.queue_depth),
       fmt::format("readback {:.2f} ms",
                   milliseconds(now.readback_sum_ns - (fresh ? capture.before.readback_sum_ns : 0), count)),
       fmt::format("compress {:.2f} ms",
                   milliseconds(now.encode_sum_ns - (fresh ? capture.before.encode_sum_ns : 0), count))},
      2, columns, lines);
  size_t width = 8;
  bool extra = false;
  for (size_t i = 0; i < now.scheme_count; ++i) {
    width = std::max(width, printable_name(now.schemes[i].name).size());
    extra |= now.schemes[i].extra_bits > 0;
  }
  // The rates come first; names are cut, and a bar is drawn only where there is room.
  const size_t rates = 2 + 8 + 8 + (extra ? 8 : 0);
  width = std::min(width, std::max<size_t>(8, columns > rates ? columns - rates : 0));
  const size_t left = columns > rates + width + 2 ? columns - rates - width - 2 : 0;
  const size_t bar = left < kLeastBarColumns ? 0 : std::min(left, kBarColumns);
  lines.push_back(
      fmt::format("  {:<{}}  {:>6}  {:>6}{}", "scheme", width, "run", "frame", extra ? "  +extra" : ""));
  for (size_t i = 0; i < now.scheme_count; ++i) {
    const LiveScheme& scheme = now.schemes[i];
    const double of_run = ratio(scheme.raw_bits, scheme.moved_bits);
    std::string line = fmt::format("  {:<{}}  {}  {}", printable_name(scheme.name).substr(0, width), width,
                                   rate_text(scheme.raw_bits, scheme.moved_bits, 6),
                                   rate_text(scheme.frame_raw_bits, scheme.frame_moved_bits, 6));
    if (extra) line.append("  ").append(rate_text(scheme.raw_bits, scheme.moved_bits + scheme.extra_bits, 6));
    if (bar > 0) line.append("  ").append(bar_of(of_run, bar));
    lines.push_back(std::move(line));
  }
  for (std::string& line : lines)
    if (line.size() > columns) line.resize(columns);
  return lines;
}

}  // namespace tilepress
