// Colour histogram: exact counts of the colours of a frame, in a bounded table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "statistics/color_buckets.h"

namespace tilepress {

/// Counts of a frame and of the one before. What the frame before had need not be put in again: most of its
/// colours come back.
class ColorHistogram {
 public:
  /// Empties it. The table will have at most `largest_size` places, and be seven eighths full then, half
  /// before. Frames of up to three eighths as many colours always have room.
  void clear(size_t largest_size);
  /// Gives its memory back; clear() before it is used again.
  void release() { *this = {}; }
  /// False: no room for another colour; the counts are not complete any more.
  bool add(uint32_t color, uint32_t count);
  /// The same for runs of pixels of one colour: bit i of `begins`, which is not 0, says that one begins at
  /// pixel i, and the last ends before `end` (at most 64).
  bool add_runs(const uint32_t* pixels, uint64_t begins, uint32_t end);
  /// 0 if the colour does not occur.
  uint32_t count(uint32_t color) const;
  /// visit(count, count in the frame before) for each colour of either frame and any number of times with 0
  /// and 0, in any order. What was counted becomes the frame before.
  template <typename Visit>
  void end_frame(const Visit& visit);
  /// visit(colour, count) for each colour of the frame before, in an order that is the same until another is
  /// added.
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
  /// Where the colour is, or the empty place where it would be.
  std::pair<size_t, uint32_t> place_of(uint32_t color) const;
  /// Whether colours may lie beyond a bucket, which then stays full.
  bool overflowed(size_t at) const;
  void reset(size_t buckets);
  /// Puts the colours of both frames into a table of so many buckets.
  void rebuild(size_t buckets);
  bool make_room();

  std::vector<ColorBucket> table_;
  std::vector<Counts> before_;  ///< of the same places
  size_t largest_ = 0;          ///< buckets
  size_t used_ = 0;             ///< colours, without colour 0
  size_t stale_ = 0;            ///< of them, at most so many are of neither frame
};

// Hardly a branch depends on the counts. Colours that came only before this frame leave, but not those that
// others may lie beyond.
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

/// How often colours occur, without the colours: what entropy and coverage are computed from. The result does
/// not depend on the order of the additions.
class CountProfile {
 public:
  static constexpr uint32_t kSmall = 1024;  ///< smaller counts are kept by number of colours

  void clear();
  /// A colour of `count` pixels; 0 is none.
  void add(uint32_t count) {
    colors_ += count != 0;
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
