// Colour histogram: exact counts of the colours of a frame, in a bounded table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tilepress {

class ColorHistogram {
 public:
  struct Entry {
    uint32_t color;
    uint32_t count;  ///< 0 = empty slot
  };

  /// Empties it. The table will have at most `largest_size` slots, and be seven eighths full then,
  /// half before.
  void clear(size_t largest_size);
  /// Gives its memory back; clear() before it is used again.
  void release() { table_ = {}; }
  /// False: no room for another colour; the counts are not complete any more.
  bool add(uint32_t color, uint32_t count);
  /// 0 if the colour does not occur.
  uint32_t count(uint32_t color) const;
  /// With empty slots in between.
  const std::vector<Entry>& table() const { return table_; }
  /// Colours held.
  size_t used() const { return used_; }

  /// A well mixed word of a colour: the top 32 bits choose the slot, those below are free for partitions.
  static uint64_t mix(uint32_t color) { return color * 0x9E3779B97F4A7C15ull; }

 private:
  size_t slot_of(uint32_t color) const { return (mix(color) >> 32) * table_.size() >> 32; }
  size_t after(size_t slot) const { return slot + 1 == table_.size() ? 0 : slot + 1; }
  bool grow();
  std::vector<Entry> table_;
  size_t largest_size_ = 0;
  size_t used_ = 0;
};

/// How often colours occur, without the colours: what entropy and coverage are computed from. The result does
/// not depend on the order of the additions.
class CountProfile {
 public:
  static constexpr uint32_t kSmall = 1024;  ///< smaller counts are kept by number of colours

  void clear();
  void add(uint32_t count) {
    ++colors_;
    if (count < kSmall)
      ++small_[count];
    else
      large_.push_back(count);
  }
  /// `colors` colours of `count` < kSmall pixels each.
  void add_small(uint32_t count, uint64_t colors) {
    colors_ += colors;
    small_[count] += static_cast<uint32_t>(colors);
  }
  /// After the last add().
  void close();
  uint64_t colors() const { return colors_; }
  /// Shannon entropy in bits per pixel; the counts add up to `pixels`.
  double entropy(double pixels) const;
  /// Sum of the `how_many` largest counts.
  uint64_t most_frequent(uint64_t how_many) const;

 private:
  std::vector<uint32_t> small_ = std::vector<uint32_t>(kSmall);  ///< number of colours by count
  std::vector<uint32_t> large_;                                  ///< the counts from kSmall on, descending
  uint64_t colors_ = 0;
};

}  // namespace tilepress
