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

void FrameMeter::count_few(bool compare, const Fvc& fvc) {
  for (const ColorHistogram::Entry& entry : now_.table()) {
    if (entry.count == 0) continue;
    profile_.add(entry.count);
    if (!compare) continue;
    const uint32_t was = before_.count(entry.color);
    change_.gained += entry.count > was ? entry.count - was : 0;
  }
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot)
    if (fvc.valid(slot)) change_.held += now_.count(fvc.color(slot));
}

void FrameMeter::count_many(const PixelPlane& frame, bool compare, const Fvc& fvc) {
  if (compare && hashed_) distribution_.load(before_);
  std::vector<uint32_t> held;
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot)
    if (fvc.valid(slot)) held.push_back(fvc.color(slot));
  change_ = distribution_.count(frame, compare, held, profile_);
}

FrameMetrics FrameMeter::measure(const PixelPlane& frame, std::optional<uint64_t> changed, const Fvc& fvc) {
  const bool compare = changed.has_value();
  profile_.clear();
  change_ = {};
  std::swap(now_, before_);
  if (!many_ && count_colors(frame, now_)) {
    count_few(compare, fvc);
    hashed_ = true;
  } else {
    count_many(frame, compare, fvc);
    hashed_ = false;
  }
  profile_.close();
  const size_t pixels = size_t{frame.width()} * frame.height();
  const auto share = [pixels](uint64_t part) {
    return static_cast<double>(part) / static_cast<double>(pixels);
  };
  // Some way below the limit before it goes back: hashing and distributing by turns costs both.
  many_ = profile_.colors() * kPixelsPerColor * (many_ ? 2 : 1) > pixels;
  if (!many_ && !hashed_) {
    hashed_ = count_colors(frame, now_);
    many_ = !hashed_;
  }

  FrameMetrics metrics;
  metrics.unique_colors = profile_.colors();
  metrics.entropy = profile_.entropy(static_cast<double>(pixels));
  // Both frames have as many pixels, so what some colours gained others lost: half the sum of all differences
  // is the sum of the gains.
  if (compare) {
    metrics.pixel_change = share(*changed);
    metrics.color_change = share(change_.gained);
  }
  uint64_t held_colors = 0;
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot) held_colors += fvc.valid(slot);
  metrics.fvc_coverage = fvc.coverage();
  metrics.fvc_relative_coverage =
      static_cast<double>(change_.held) / static_cast<double>(profile_.most_frequent(held_colors));
  metrics.top100_coverage = share(profile_.most_frequent(100));
  return metrics;
}

}  // namespace tilepress
