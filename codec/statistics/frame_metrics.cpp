// Frame metrics: histograms, whole or in parts, and the figures read off them.
#include "statistics/frame_metrics.h"

#include <algorithm>
#include <array>
#include <utility>

#include "dcp/fvc.h"

namespace tilepress {
namespace {

/// Histograms of two frames together stay below one raw frame of 4 bytes a pixel.
size_t largest_table(const PixelPlane& frame) {
  const size_t pixels = size_t{frame.width()} * frame.height();
  return std::max<size_t>(1024, pixels / 17 * 4);
}

/// Partition bits of a colour: not those that choose its slot.
uint32_t partition_of(uint32_t color) {
  return static_cast<uint32_t>(ColorHistogram::mix(color) >> 20);
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

bool FrameMeter::count_colors(const PixelPlane& frame, uint32_t mask, uint32_t part, ColorHistogram& out) {
  out.clear(largest_table_);
  RunCache cache(out);
  for (uint32_t y = 0; y < frame.height(); ++y) {
    const uint32_t* row = frame.row(y);
    for (uint32_t x = 0; x < frame.width();) {
      const uint32_t color = row[x], first = x;
      while (++x < frame.width() && row[x] == color) {
      }
      if (mask != 0 && (partition_of(color) & mask) != part) continue;
      if (!cache.add(color, x - first)) return false;
    }
  }
  return cache.flush();
}

void FrameMeter::add_part(bool compare, const Fvc& fvc, uint32_t mask, uint32_t part) {
  for (const ColorHistogram::Entry& entry : now_.table()) {
    if (entry.count == 0) continue;
    profile_.add(entry.count);
    if (!compare) continue;
    const uint32_t was = before_.count(entry.color);
    gained_ += entry.count > was ? entry.count - was : 0;
  }
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot)
    if (fvc.valid(slot) && (partition_of(fvc.color(slot)) & mask) == part)
      held_true_ += now_.count(fvc.color(slot));
}

bool FrameMeter::count_in_parts(const PixelPlane& frame, const PixelPlane* before, const Fvc& fvc,
                                uint32_t parts) {
  profile_.clear();
  gained_ = held_true_ = 0;
  size_t fullest = 0;
  for (uint32_t part = 0; part < parts; ++part) {
    const bool kept = parts == 1 && before_valid_;  // before_ holds that frame already
    if (!count_colors(frame, parts - 1, part, now_) ||
        (before != nullptr && !kept && !count_colors(*before, parts - 1, part, before_)))
      return false;
    fullest = std::max({fullest, now_.used(), before_.used()});
    add_part(before != nullptr, fvc, parts - 1, part);
  }
  parts_ = fullest * 3 < largest_table_ && parts > 1 ? parts / 2 : parts;
  return true;
}

FrameMetrics FrameMeter::measure(const PixelPlane& frame, const PixelPlane* before, const Fvc& fvc) {
  largest_table_ = largest_table(frame);
  std::swap(now_, before_);
  uint32_t parts = parts_;
  while (!count_in_parts(frame, before, fvc, parts)) {
    parts *= 2;
    before_valid_ = false;
  }
  before_valid_ = parts == 1;
  profile_.close();

  const double pixels = static_cast<double>(frame.width()) * frame.height();
  FrameMetrics metrics;
  metrics.unique_colors = profile_.colors();
  metrics.entropy = profile_.entropy(pixels);
  if (before != nullptr) {
    // Both frames have as many pixels, so what some colours gained others lost: half the sum of all
    // differences is the sum of the gains.
    metrics.color_change = static_cast<double>(gained_) / pixels;
    uint64_t changed = 0;
    for (uint32_t y = 0; y < frame.height(); ++y) {
      const uint32_t *now = frame.row(y), *then = before->row(y);
      for (uint32_t x = 0; x < frame.width(); ++x) changed += now[x] != then[x];
    }
    metrics.pixel_change = static_cast<double>(changed) / pixels;
  }
  uint64_t held_colors = 0;
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot) held_colors += fvc.valid(slot);
  metrics.fvc_coverage = fvc.coverage();
  metrics.fvc_relative_coverage =
      static_cast<double>(held_true_) / static_cast<double>(profile_.most_frequent(held_colors));
  metrics.top100_coverage = static_cast<double>(profile_.most_frequent(100)) / pixels;
  return metrics;
}

}  // namespace tilepress
