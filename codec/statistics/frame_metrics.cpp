// Frame metrics: one histogram per frame, compared with the one before.
#include "statistics/frame_metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "dcp/fvc.h"

namespace tilepress {

void ColorHistogram::clear() {
  std::fill(table_.begin(), table_.end(), Entry{0, 0});
  used_ = 0;
}

void ColorHistogram::add(uint32_t color, uint32_t count) {
  size_t at = slot_of(color);
  while (table_[at].count != 0 && table_[at].color != color) at = (at + 1) & (table_.size() - 1);
  if (table_[at].count == 0) {
    table_[at].color = color;
    if (++used_ * 2 > table_.size()) {
      table_[at].count = count;
      return grow();
    }
  }
  table_[at].count += count;
}

uint32_t ColorHistogram::count(uint32_t color) const {
  for (size_t at = slot_of(color);; at = (at + 1) & (table_.size() - 1))
    if (table_[at].count == 0 || table_[at].color == color) return table_[at].count;
}

void ColorHistogram::grow() {
  std::vector<Entry> old(table_.size() * 2);
  old.swap(table_);
  --shift_;
  for (const Entry& entry : old) {
    if (entry.count == 0) continue;
    size_t at = slot_of(entry.color);
    while (table_[at].count != 0) at = (at + 1) & (table_.size() - 1);
    table_[at] = entry;
  }
}

void FrameMeter::count_colors(const PixelPlane& frame) {
  now_.clear();
  for (uint32_t y = 0; y < frame.height(); ++y) {
    const uint32_t* row = frame.row(y);
    for (uint32_t x = 0; x < frame.width();) {
      const uint32_t color = row[x], first = x;
      while (++x < frame.width() && row[x] == color) {
      }
      now_.add(color, x - first);
    }
  }
}

FrameMetrics FrameMeter::measure(const PixelPlane& frame, const PixelPlane* before, const Fvc& fvc) {
  std::swap(now_, before_);
  count_colors(frame);
  const double pixels = static_cast<double>(frame.width()) * frame.height();
  FrameMetrics metrics;
  metrics.unique_colors = now_.unique_colors();

  uint64_t differences = 0;  // of the two histograms, both directions
  counts_.clear();
  for (const ColorHistogram::Entry& entry : now_.table()) {
    if (entry.count == 0) continue;
    counts_.push_back(entry.count);
    const double share = entry.count / pixels;
    metrics.entropy -= share * std::log2(share);
    if (before == nullptr) continue;
    const uint32_t was = before_.count(entry.color);
    differences += entry.count > was ? entry.count - was : 0;
  }
  metrics.entropy = std::max(metrics.entropy, 0.0);
  if (before != nullptr) {
    // Both frames have as many pixels, so what some colours gained others lost: half the sum of all
    // differences is the sum of the gains.
    metrics.color_change = static_cast<double>(differences) / pixels;
    uint64_t changed = 0;
    for (uint32_t y = 0; y < frame.height(); ++y) {
      const uint32_t *now = frame.row(y), *then = before->row(y);
      for (uint32_t x = 0; x < frame.width(); ++x) changed += now[x] != then[x];
    }
    metrics.pixel_change = static_cast<double>(changed) / pixels;
  }

  const auto most_frequent = [&](size_t how_many) {
    how_many = std::min(how_many, counts_.size());
    std::nth_element(counts_.begin(), counts_.begin() + static_cast<ptrdiff_t>(how_many), counts_.end(),
                     std::greater<>());
    uint64_t sum = 0;
    for (size_t i = 0; i < how_many; ++i) sum += counts_[i];
    return sum;
  };
  uint64_t held_true = 0, held_colors = 0;
  for (uint32_t slot = 0; slot < fvc.slots(); ++slot) {
    if (!fvc.valid(slot)) continue;
    held_true += now_.count(fvc.color(slot));
    ++held_colors;
  }
  metrics.fvc_coverage = fvc.coverage();
  metrics.fvc_relative_coverage =
      static_cast<double>(held_true) / static_cast<double>(most_frequent(held_colors));
  metrics.top100_coverage = static_cast<double>(most_frequent(100)) / pixels;
  return metrics;
}

}  // namespace tilepress
