// Frame metrics: colour histogram and what is read off it (spec §8).
#pragma once

#include <cstdint>
#include <vector>

#include "tilepress/plane.h"
#include "tilepress/statistics.h"

namespace tilepress {

class Fvc;

/// Exact counts of every colour of a frame.
class ColorHistogram {
 public:
  struct Entry {
    uint32_t color;
    uint32_t count;  ///< 0 = empty slot
  };
  void clear();
  void add(uint32_t color, uint32_t count);
  /// 0 if the colour does not occur.
  uint32_t count(uint32_t color) const;
  uint64_t unique_colors() const { return used_; }
  /// Table with empty slots in between.
  const std::vector<Entry>& table() const { return table_; }

 private:
  size_t slot_of(uint32_t color) const { return (color * 0x9E3779B97F4A7C15ull) >> shift_; }
  void grow();
  std::vector<Entry> table_ = std::vector<Entry>(1024);
  uint32_t shift_ = 64 - 10;
  uint64_t used_ = 0;
};

/// Keeps the histogram of the frame before.
class FrameMeter {
 public:
  /// Measures `frame`; `before` is the frame before it, or null. `fvc` is the default FVC, fed with `frame`.
  FrameMetrics measure(const PixelPlane& frame, const PixelPlane* before, const Fvc& fvc);

 private:
  void count_colors(const PixelPlane& frame);
  ColorHistogram now_, before_;
  std::vector<uint32_t> counts_;
};

}  // namespace tilepress
