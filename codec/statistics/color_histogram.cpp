// Colour histogram: open addressing. Count profile: entropy and coverage.
#include "statistics/color_histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "statistics/histogram_kernels.h"

namespace tilepress {

void ColorHistogram::reset(size_t buckets) {
  table_.assign(buckets, ColorBucket{});
  before_.assign(buckets, Counts{});
  used_ = stale_ = 0;
}

void ColorHistogram::clear(size_t largest_size) {
  constexpr size_t kSmallest = 128;
  largest_ = largest_size / kPlaces;
  reset(table_.empty() || table_.size() > largest_ ? std::min(kSmallest, largest_) : table_.size());
}

bool ColorHistogram::overflowed(size_t at) const {
  while (table_[at].colors[kPlaces - 1] != 0) {
    at = after(at);
    const uint32_t* colors = table_[at].colors;
    if (std::any_of(colors, colors + kPlaces, [&](uint32_t color) {
          return color != 0 && ColorBucket::of(color, table_.size()) != at;
        }))
      return true;
  }
  return false;
}

std::pair<size_t, uint32_t> ColorHistogram::place_of(uint32_t color) const {
  size_t at = ColorBucket::of(color, table_.size());
  for (;; at = after(at)) {
    uint32_t place = table_[at].find(color);
    if (place == kPlaces) place = table_[at].find(0);
    if (place != kPlaces) return {at, place};
  }
}

bool ColorHistogram::add(uint32_t color, uint32_t count) {
  for (;;) {
    const auto [at, place] = place_of(color);
    ColorBucket& bucket = table_[at];
    if (bucket.colors[place] == color) {
      bucket.counts[place] += count;
      return true;
    }
    const bool largest = table_.size() >= largest_;  // no smaller one gets as full
    if ((used_ + 1) * 8 <= table_.size() * kPlaces * (largest ? 7 : 4)) {
      bucket.colors[place] = color;
      bucket.counts[place] = count;
      ++used_;
      return true;
    }
    if (!make_room()) return false;
  }
}

bool ColorHistogram::add_runs(const uint32_t* pixels, uint64_t begins, uint32_t end) {
  uint64_t left = histogram_kernels().count_runs(pixels, begins, end, table_.data(), table_.size());
  for (; left != 0; left &= left - 1) {
    const auto first = static_cast<uint32_t>(std::countr_zero(left));
    const uint64_t later = begins & ~uint64_t{1} << first;
    const uint32_t next = later != 0 ? static_cast<uint32_t>(std::countr_zero(later)) : end;
    if (!add(pixels[first], next - first)) return false;
  }
  return true;
}

uint32_t ColorHistogram::count(uint32_t color) const {
  const auto [at, place] = place_of(color);
  return table_[at].counts[place];
}

bool ColorHistogram::make_room() {
  const bool larger = table_.size() < largest_;
  if (!larger && stale_ * 8 < table_.size() * kPlaces) return false;
  rebuild(larger ? std::min(table_.size() * 2, largest_) : largest_);
  return true;
}

void ColorHistogram::rebuild(size_t buckets) {
  const std::vector<ColorBucket> table = std::move(table_);
  const std::vector<Counts> before = std::move(before_);
  reset(buckets);
  for (size_t from = 0; from < table.size(); ++from)
    for (uint32_t i = 0; i < kPlaces; ++i) {
      const uint32_t color = table[from].colors[i];
      if (table[from].counts[i] == 0 && before[from][i] == 0) continue;
      const auto [at, place] = place_of(color);
      table_[at].colors[place] = color;
      table_[at].counts[place] = table[from].counts[i];
      before_[at][place] = before[from][i];
      used_ += color != 0;
    }
}

void CountProfile::clear() {
  std::fill(small_.begin(), small_.end(), 0u);
  large_.clear();
  colors_ = 0;
}

void CountProfile::close() {
  std::sort(large_.begin(), large_.end(), std::greater<>());
}

double CountProfile::entropy(double pixels) const {
  // -Σ n/P log2(n/P) = log2 P - (Σ n log2 n) / P, in ascending order of n: no order of colours enters.
  double sum = 0;
  for (uint32_t count = 2; count < kSmall; ++count)
    if (small_[count] != 0) sum += static_cast<double>(small_[count]) * count * std::log2(count);
  for (size_t i = large_.size(); i-- > 0;) sum += large_[i] * std::log2(large_[i]);
  return std::max(0.0, std::log2(pixels) - sum / pixels);
}

uint64_t CountProfile::most_frequent(uint64_t how_many) const {
  uint64_t sum = 0;
  for (size_t i = 0; i < large_.size() && how_many > 0; ++i, --how_many) sum += large_[i];
  for (uint32_t count = kSmall - 1; count > 0 && how_many > 0; --count) {
    const uint64_t taken = std::min<uint64_t>(how_many, small_[count]);
    sum += taken * count;
    how_many -= taken;
  }
  return sum;
}

}  // namespace tilepress
