// Colour distribution: exact colour counts of frames of many colours, by sorting pixels into groups.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "statistics/color_histogram.h"
#include "tilepress/plane.h"

namespace tilepress {

/// A colour and the pixels that have it.
struct WantedColor {
  uint32_t color;
  uint32_t count = 0;
};

/// The upper 16 bits of a pixel word select its group; the lower 16 bits index a table of counts. Without a
/// search, noise costs little more than shades. If neighbours are often alike, a run counts as one pixel with
/// a weight. The object keeps the groups of the last frame.
///
/// Memory: 2 bytes per pixel or 3 bytes per run, and 64 KiB, for this frame and the last one; and one
/// megabyte that all surfaces of a thread share.
class ColorDistribution {
 public:
  /// Makes the frame before the frame in `colors` the last one.
  void load_before(const ColorHistogram& colors);
  /// Adds the counts of the colours of `frame` to `profile`, and makes `frame` the last one. `compare`
  /// requires a last frame of as many pixels. Counts the pixels of `wanted`, which are distinct and sorted,
  /// of count 0. Returns how many pixels colours gained since the frame before; 0 without `compare`.
  uint64_t count(const PixelPlane& frame, bool compare, std::span<WantedColor> wanted, CountProfile& profile);

 private:
  /// The lower halves of the words of a frame's pixels or runs, group after group.
  struct Grouped {
    std::vector<uint16_t> values;
    std::vector<uint8_t> weights;  ///< pixels of a run; empty if each value is of one pixel
    std::vector<uint8_t> sizes;    ///< by group; kManyValues: in `large_sizes`, in order
    std::vector<uint32_t> large_sizes;
  };
  static constexpr uint32_t kGroups = 65536, kManyValues = 255;
  struct Tables;
  static Tables& tables_of_thread();
  /// Notes the sizes of the groups in `out`, and replaces them in `ends` by the groups' beginnings.
  static void note_sizes(std::vector<uint32_t>& ends, Grouped& out);
  static void distribute(const PixelPlane& frame, std::vector<uint32_t>& ends, Grouped& out);
  static uint64_t count_groups(Tables& tables, const Grouped& now, const Grouped* before,
                               std::span<WantedColor> wanted, CountProfile& profile);

  Grouped last_, spare_;
};

}  // namespace tilepress
