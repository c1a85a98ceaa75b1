// Frame metrics: counts the colours and computes the figures.
#include "statistics/frame_metrics.h"

#include <algorithm>
#include <utility>

#include "cpu/bit_count.h"
#include "dcp/fvc.h"

namespace tilepress {
namespace {

/// With fewer pixels per colour, distributing pixels is faster than hashing colours. In large frames the hash
/// table leaves the caches; in small frames a walk over all groups takes long.
size_t pixels_per_color(size_t pixels) {
  return pixels < 1u << 18 ? 12 : 64;
}

/// Returns the places for the colours of two such frames. They take an eighth of a raw frame of 4 bytes per
/// pixel, or two thirds of a small one.
size_t largest_table(size_t pixels) {
  return std::max<size_t>(1024, pixels * 8 / 3 / pixels_per_color(pixels));
}

template <typename Visit>
void for_each_color(const Fvc& fvc, const Visit& visit) {
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot)
    if (fvc.valid(slot)) visit(fvc.color(slot));
}

}  // namespace

bool FrameMeter::take(uint32_t color, uint32_t count) {
  RecentColor& entry = recent_[(color * 0x9E3779B1u) >> 21];
  if (entry.color == color) {
    entry.count += count;
    return true;
  }
  const bool room = entry.count == 0 || counts_.add(entry.color, entry.count);
  entry = {color, count};
  return room;
}

bool FrameMeter::flush() {
  bool room = true;
  for (RecentColor& entry : recent_) {
    if (entry.count != 0) room = room && counts_.add(entry.color, entry.count);
    entry = {};
  }
  return room;
}

void FrameMeter::begin_frame(size_t pixels) {
  counting_ = !many_;
  if (counting_ && !hashed_) counts_.clear(largest_table(pixels));
}

void FrameMeter::see_all(const uint32_t* pixels, uint32_t count) {
  for (uint32_t i = 0; counting_ && i < count;) {
    const uint32_t first = i;
    while (++i < count && pixels[i] == pixels[first]) {
    }
    see_run(pixels[first], i - first);
  }
}

void FrameMeter::see_pixels(const uint32_t* pixels, uint32_t count, uint64_t alike) {
  if (!counting_) return;
  const uint64_t begins = (~alike & ~uint64_t{0} >> (kBlockPixels - count)) | 1;
  counting_ =
      counts_.add_runs(pixels, begins, count);  // not through recent_: these colours rarely come back soon
}

void FrameMeter::see_block(const FewColors& few) {
  for (uint32_t n = 0; n < few.count; ++n) see_run(few.colors[n], bit_count(few.places[n]));
}

void FrameMeter::count_few(bool compare, std::span<const Fvc* const> fvcs) {
  for (size_t i = 0; i < fvcs.size(); ++i)
    for_each_color(*fvcs[i], [&](uint32_t color) { held_[i] += counts_.count(color); });
  counts_.end_frame([&](uint32_t count, uint32_t before) {
    profile_.add(count);
    gained_ += std::max(count, before) - before;
  });
  if (!compare) gained_ = 0;
}

void FrameMeter::count_many(const PixelPlane& frame, bool compare, std::span<const Fvc* const> fvcs) {
  if (compare && hashed_) distribution_.load_before(counts_);
  std::vector<WantedColor> colors;
  for (const Fvc* fvc : fvcs) for_each_color(*fvc, [&](uint32_t color) { colors.push_back({color}); });
  std::ranges::sort(colors, {}, &WantedColor::color);
  const auto same = [](const WantedColor& a, const WantedColor& b) { return a.color == b.color; };
  colors.erase(std::unique(colors.begin(), colors.end(), same), colors.end());
  gained_ = distribution_.count(frame, compare, colors, profile_);
  for (size_t i = 0; i < fvcs.size(); ++i)
    for_each_color(*fvcs[i], [&](uint32_t color) {
      held_[i] += std::ranges::lower_bound(colors, color, {}, &WantedColor::color)->count;
    });
}

FrameMetrics FrameMeter::measure(const PixelPlane& frame, std::optional<uint64_t> changed,
                                 std::span<const Fvc* const> fvcs) {
  const bool compare = changed.has_value();
  profile_.clear();
  gained_ = 0;
  held_.assign(fvcs.size(), 0);
  const bool counted = flush() && counting_;
  if (counted)
    count_few(compare, fvcs);
  else
    count_many(frame, compare, fvcs);
  hashed_ = counted;
  profile_.close();
  const size_t pixels = size_t{frame.width()} * frame.height();
  const auto share = [pixels](uint64_t part) {
    return static_cast<double>(part) / static_cast<double>(pixels);
  };
  // Returns to hashing only well below the limit, since a switch costs both ways.
  many_ = profile_.colors() * pixels_per_color(pixels) * (many_ ? 2 : 1) > pixels;
  if (!many_ && !hashed_) {
    counts_.clear(largest_table(pixels));
    counting_ = true;
    for (uint32_t y = 0; y < frame.height(); ++y) see_all(frame.row(y), frame.width());
    hashed_ = flush() && counting_;
    if (hashed_) counts_.end_frame([](uint32_t, uint32_t) {});
    many_ = !hashed_;
  }
  if (many_ && !hashed_) counts_.release();

  FrameMetrics metrics;
  metrics.unique_colors = profile_.colors();
  metrics.entropy = profile_.entropy(static_cast<double>(pixels));
  // Both frames have the same number of pixels, so some colours gain what others lose: half the sum of all
  // differences is the sum of the gains.
  if (compare) {
    metrics.pixel_change = share(*changed);
    metrics.color_change = share(gained_);
  }
  figures_.clear();
  for (size_t i = 0; i < fvcs.size(); ++i) {
    uint64_t held_colors = 0;
    for_each_color(*fvcs[i], [&](uint32_t) { ++held_colors; });
    const auto most = static_cast<double>(profile_.most_frequent(held_colors));
    figures_.push_back({fvcs[i]->coverage(), static_cast<double>(held_[i]) / most});
  }
  metrics.fvc_coverage = figures_.front().coverage;
  metrics.fvc_relative_coverage = figures_.front().relative_coverage;
  metrics.top100_coverage = share(profile_.most_frequent(100));
  return metrics;
}

}  // namespace tilepress
