// Color distribution: exact colour counts of frames of many colours, by sorting pixels into groups.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "statistics/color_histogram.h"
#include "tilepress/plane.h"

namespace tilepress {

/// Pixels are distributed to groups by the upper 16 bits of their word; the lower 16 bits then index a table
/// of counts directly. No search and hardly a branch depends on the colours, so a frame of noise costs little
/// more than a frame of shades. Where neighbours are often alike, a run of them counts like one pixel that
/// weighs more. The pixels of the last frame are kept by group for the next.
///
/// Memory: of the frame and the last one 2 bytes a pixel, or 3 bytes a run, and 64 KiB; and a megabyte that
/// all surfaces of a thread share.
class ColorDistribution {
 public:
  struct Change {
    uint64_t gained = 0;  ///< pixels that colours gained since the frame before; 0 without one
    uint64_t held = 0;    ///< pixels whose colour is one of `held_colors`
  };
  /// Makes the frame before the one in `colors` the last one.
  void load_before(const ColorHistogram& colors);
  /// Adds the counts of the colours of `frame` to `profile`, and makes it the last one. `compare` it to the
  /// last frame, which had as many pixels. `held_colors` are distinct; their order is changed.
  Change count(const PixelPlane& frame, bool compare, std::span<uint32_t> held_colors, CountProfile& profile);

 private:
  /// The lower halves of the pixels or runs of a frame, group after group.
  struct Grouped {
    std::vector<uint16_t> values;
    std::vector<uint8_t> weights;  ///< pixels of a run; empty if each value is of one pixel
    std::vector<uint8_t> sizes;    ///< by group; kManyValues: in `large_sizes`, in order
    std::vector<uint32_t> large_sizes;
  };
  static constexpr uint32_t kGroups = 65536, kManyValues = 255;
  struct Tables;
  static Tables& tables_of_thread();
  /// From the sizes of the groups in `ends` to their beginnings, noted in `out`.
  static void note_sizes(std::vector<uint32_t>& ends, Grouped& out);
  static void distribute(const PixelPlane& frame, std::vector<uint32_t>& ends, Grouped& out);
  static Change count_groups(Tables& tables, const Grouped& now, const Grouped* before,
                             std::span<const uint32_t> held_colors, CountProfile& profile);

  Grouped last_, spare_;
};

}  // namespace tilepress
