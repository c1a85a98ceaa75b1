// Colour histogram: exact counts of the colours of a frame, in a bounded table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "statistics/color_buckets.h"

namespace tilepress {

/// Counts of a frame and of the frame before. Colours of the frame before stay in the table, since most of
/// them come back.
class ColorHistogram {
 public:
  /// Empties the table. It grows up to `largest_size` places, and is then up to seven eighths full, before
  /// that up to half. Frames of up to three eighths as many colours always have room.
  void clear(size_t largest_size);
  /// Frees the memory. Call clear() before the next use.
  void release() { *this = {}; }
  /// Adds to a colour's count. Returns false if there is no room for another colour; the counts are
  /// incomplete then.
  bool add(uint32_t color, uint32_t count);
  /// The same for runs of pixels of one colour. A run begins at each set bit of `begins`, which is not 0. The
  /// last run ends before `end` (at most 64).
  bool add_runs(const uint32_t* pixels, uint64_t begins, uint32_t end);
  /// Returns 0 if the colour does not occur.
  uint32_t count(uint32_t color) const;
  /// Calls visit(count, count in the frame before) for each colour of either frame, in any order, and any
  /// number of times with (0, 0). The frame becomes the frame before.
  template <typename Visit>
  void end_frame(const Visit& visit);
  /// Calls visit(colour, count) for each colour of the frame before. The order stays the same until a colour
  /// is added.
  template <typename Visit>
  void for_each_before(const Visit& visit) const {
    for (size_t at = 0; at < table_.size(); ++at)
      for (uint32_t place = 0; place < kPlaces; ++place)
        if (before_[at][place] != 0) visit(table_[at].colors[place], before_[at][place]);
  }

 private:
  static constexpr uint32_t kPlaces = ColorBucket::kPlaces;
  using Counts = std::array<uint32_t, kPlaces>;

  size_t after(size_t at) const { return at + 1 == table_.size() ? 1 : at + 1; }
  /// Returns the place of the colour, or the empty place for it.
  std::pair<size_t, uint32_t> place_of(uint32_t color) const;
  /// Returns true if colours may lie beyond a bucket. Such a bucket stays full.
  bool overflowed(size_t at) const;
  void reset(size_t buckets);
  /// Moves the colours of both frames into a table of `buckets` buckets.
  void rebuild(size_t buckets);
  bool make_room();

  std::vector<ColorBucket> table_;
  std::vector<Counts> before_;  ///< of the same places
  size_t largest_ = 0;          ///< buckets
  size_t used_ = 0;             ///< colours, without colour 0
  size_t stale_ = 0;            ///< upper bound of the used colours that neither frame has
};

// Few branches depend on the counts. A colour that only the frame before had leaves, unless colours may lie
// beyond its bucket.
template <typename Visit>
void ColorHistogram::end_frame(const Visit& visit) {
  stale_ = 0;
  for (size_t at = 0; at < table_.size(); ++at) {
    ColorBucket& bucket = table_[at];
    Counts& before = before_[at];
    const bool keep = overflowed(at);
    uint32_t kept = 0;
    for (uint32_t place = 0; place < kPlaces; ++place) {
      const uint32_t color = bucket.colors[place], count = bucket.counts[place];
      visit(count, before[place]);
      bucket.colors[place] = bucket.counts[place] = before[place] = 0;
      const bool stays = keep || count != 0;
      bucket.colors[kept] = stays ? color : 0;
      before[kept] = count;
      kept += stays;
      used_ -= color != 0 && !stays;
      stale_ += keep && count == 0;
    }
  }
}

/// The counts of a frame's colours without the colours, for entropy and coverage. The order of the additions
/// does not change the result.
class CountProfile {
 public:
  static constexpr uint32_t kSmall = 1024;  ///< smaller counts are stored as numbers of colours

  void clear();
  /// Adds a colour of `count` pixels; 0 adds none.
  void add(uint32_t count) {
    colors_ += count != 0;
    if (count < kSmall)
      ++small_[count];
    else
      large_.push_back(count);
  }
  /// Adds `colors` colours of `count` < kSmall pixels each.
  void add_small(uint32_t count, uint64_t colors) {
    colors_ += colors;
    small_[count] += static_cast<uint32_t>(colors);
  }
  /// Call it after the last add().
  void close();
  uint64_t colors() const { return colors_; }
  /// Returns the Shannon entropy in bits per pixel. The counts add up to `pixels`.
  double entropy(double pixels) const;
  /// Returns the sum of the `how_many` largest counts.
  uint64_t most_frequent(uint64_t how_many) const;

 private:
  std::vector<uint32_t> small_ = std::vector<uint32_t>(kSmall);  ///< number of colours by count
  std::vector<uint32_t> large_;                                  ///< the counts from kSmall on, descending
  uint64_t colors_ = 0;
};

}  // namespace tilepress
