// Colour histogram: open addressing; and the profile of its counts.
#include "statistics/color_histogram.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace tilepress {

void ColorHistogram::clear(size_t largest_size) {
  largest_size_ = largest_size;
  if (table_.empty() || table_.size() > largest_size_) {
    table_ = std::vector<Entry>(std::min<size_t>(1024, largest_size_));
  } else {
    std::fill(table_.begin(), table_.end(), Entry{0, 0});
  }
  used_ = 0;
}

bool ColorHistogram::add(uint32_t color, uint32_t count) {
  for (;;) {
    size_t at = slot_of(color);
    while (table_[at].count != 0 && table_[at].color != color) at = after(at);
    if (table_[at].count != 0) {
      table_[at].count += count;
      return true;
    }
    const bool largest = table_.size() >= largest_size_;  // no smaller one gets as full
    if ((used_ + 1) * 8 <= table_.size() * (largest ? 7 : 4)) {
      table_[at] = {color, count};
      ++used_;
      return true;
    }
    if (!grow()) return false;
  }
}

uint32_t ColorHistogram::count(uint32_t color) const {
  for (size_t at = slot_of(color);; at = after(at))
    if (table_[at].count == 0 || table_[at].color == color) return table_[at].count;
}

bool ColorHistogram::grow() {
  if (table_.size() >= largest_size_) return false;
  std::vector<Entry> old(std::min(table_.size() * 2, largest_size_));
  old.swap(table_);
  for (const Entry& entry : old) {
    if (entry.count == 0) continue;
    size_t at = slot_of(entry.color);
    while (table_[at].count != 0) at = after(at);
    table_[at] = entry;
  }
  return true;
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
