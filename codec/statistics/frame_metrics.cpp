// Frame metrics: colour counts of a frame and the one before, and the figures read off them.
#include "statistics/frame_metrics.h"

#include <algorithm>
#include <array>
#include <utility>

#include "dcp/fvc.h"

namespace tilepress {
namespace {

/// With fewer pixels to a colour, distributing them is quicker than hashing the colours.
constexpr size_t kPixelsPerColor = 64;

/// Slots for a frame of as many colours; two tables take an eighth of a raw frame of 4 bytes a pixel.
size_t largest_table(const PixelPlane& frame) {
  const size_t pixels = size_t{frame.width()} * frame.height();
  return std::max<size_t>(1024, pixels * 2 / kPixelsPerColor);
}

/// Takes runs of a colour together before they go to the large table: most colours come back soon.
class RunCache {
 public:
  explicit RunCache(ColorHistogram& out) : out_(out) {}
  bool add(uint32_t color, uint32_t count) {
    ColorHistogram::Entry& entry = entries_[(color * 0x9E3779B1u) >> 23];
    if (entry.color == color) {
      entry.count += count;
      return true;
    }
    const bool room = entry.count == 0 || out_.add(entry.color, entry.count);
    entry = {color, count};
    return room;
  }
  bool flush() {
    bool room = true;
    for (ColorHistogram::Entry& entry : entries_)
      if (entry.count != 0) room = room && out_.add(entry.color, entry.count);
    return room;
  }

 private:
  ColorHistogram& out_;
  std::array<ColorHistogram::Entry, 512> entries_{};
};

}  // namespace

bool FrameMeter::count_colors(const PixelPlane& frame, ColorHistogram& out) {
  out.clear(largest_table(frame));
  RunCache cache(out);
  for (uint32_t y = 0; y < frame.height(); ++y) {
    const uint32_t* row = frame.row(y);
    for (uint32_t x = 0; x < frame.width();) {
      const uint32_t color = row[x], first = x;
      while (++x < frame.width() && row[x] == color) {
      }
      if (!cache.add(color, x - first)) return false;
    }
  }
  return cache.flush();
}

bool FrameMeter::count_few(const PixelPlane& frame, const PixelPlane* before, const Fvc& fvc) {
  std::swap(now_, before_);
  const bool kept = std::exchange(before_valid_, false);
  if (!count_colors(frame, now_)) return false;
  before_valid_ = true;  // for the next frame
  if (before != nullptr && !kept && !count_colors(*before, before_)) return false;
  for (const ColorHistogram::Entry& entry : now_.table()) {
    if (entry.count == 0) continue;
    profile_.add(entry.count);
    if (before == nullptr) continue;
    const uint32_t was = before_.count(entry.color);
    change_.gained += entry.count > was ? entry.count - was : 0;
  }
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot)
    if (fvc.valid(slot)) change_.held += now_.count(fvc.color(slot));
  return true;
}

void FrameMeter::count_many(const PixelPlane& frame, PixelPlane* before, const Fvc& fvc) {
  std::vector<uint32_t> held;
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot)
    if (fvc.valid(slot)) held.push_back(fvc.color(slot));
  change_ = distribution_.count(frame, before, held, profile_);
}

FrameMetrics FrameMeter::measure(const PixelPlane& frame, PixelPlane* before, const Fvc& fvc) {
  const double pixels = static_cast<double>(frame.width()) * frame.height();
  FrameMetrics metrics;
  if (before != nullptr) {
    uint64_t changed = 0;
    for (uint32_t y = 0; y < frame.height(); ++y) {
      const uint32_t *now = frame.row(y), *then = before->row(y);
      for (uint32_t x = 0; x < frame.width(); ++x) changed += now[x] != then[x];
    }
    metrics.pixel_change = static_cast<double>(changed) / pixels;
  }
  profile_.clear();
  change_ = {};
  if (many_ || !count_few(frame, before, fvc)) count_many(frame, before, fvc);
  profile_.close();
  metrics.unique_colors = profile_.colors();
  metrics.entropy = profile_.entropy(pixels);
  // Both frames have as many pixels, so what some colours gained others lost: half the sum of all differences
  // is the sum of the gains.
  metrics.color_change = before != nullptr ? static_cast<double>(change_.gained) / pixels : 0;
  many_ = profile_.colors() * kPixelsPerColor > size_t{frame.width()} * frame.height();
  before_valid_ = before_valid_ && !many_;
  uint64_t held_colors = 0;
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot) held_colors += fvc.valid(slot);
  metrics.fvc_coverage = fvc.coverage();
  metrics.fvc_relative_coverage =
      static_cast<double>(change_.held) / static_cast<double>(profile_.most_frequent(held_colors));
  metrics.top100_coverage = static_cast<double>(profile_.most_frequent(100)) / pixels;
  return metrics;
}

}  // namespace tilepress
