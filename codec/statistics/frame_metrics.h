// Frame metrics: figures from the colour counts of a frame and the frame before.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dcp/fast_fvc.h"
#include "pixels/few_colors.h"
#include "statistics/color_distribution.h"
#include "statistics/color_histogram.h"
#include "tilepress/plane.h"
#include "tilepress/statistics.h"

namespace tilepress {

class Fvc;

/// Counts frames of few colours in hash tables that together take an eighth of a raw frame, and distributes
/// frames of many colours. Keeps the colours for the next frame either way.
class FrameMeter final : public ColorListener {
 public:
  /// Begins a frame of `pixels` pixels. The meter must see each pixel once, in any order.
  void begin_frame(size_t pixels);
  /// False if the meter needs no pixels of this frame before measure().
  bool counting() const { return counting_; }
  void see_run(uint32_t color, uint32_t count) override {
    if (counting_ && !take(color, count)) counting_ = false;
  }
  void see_pixels(const uint32_t* pixels, uint32_t count, uint64_t alike) override;
  void see_all(const uint32_t* pixels, uint32_t count);
  void see_block(const FewColors& few);
  /// Measures `frame` after the meter has seen it. `changed` counts the pixels that differ from the frame
  /// measured last, of the same size; none if there is no such frame. `fvcs` are FVCs after `frame`, the
  /// default one first; figures_of() has their figures then.
  FrameMetrics measure(const PixelPlane& frame, std::optional<uint64_t> changed,
                       std::span<const Fvc* const> fvcs);
  /// The figures of `fvcs[i]`.
  const FvcFigures& figures_of(size_t i) const { return figures_[i]; }

 private:
  /// Returns false if there is no room.
  bool take(uint32_t color, uint32_t count);
  bool flush();
  void count_few(bool compare, std::span<const Fvc* const> fvcs);
  void count_many(const PixelPlane& frame, bool compare, std::span<const Fvc* const> fvcs);

  ColorHistogram counts_;
  /// A small cache of counts before the large table, since most colours come back soon.
  struct RecentColor {
    uint32_t color, count;  ///< count 0: none
  };
  std::array<RecentColor, 2048> recent_{};
  bool counting_ = false;  ///< into counts_
  bool hashed_ = false;    ///< the last frame is in counts_; else in distribution_
  bool many_ = false;      ///< the next frame probably has many colours
  ColorDistribution distribution_;
  CountProfile profile_;
  uint64_t gained_ = 0;              ///< pixels that colours gained since the frame before
  std::vector<uint64_t> held_;       ///< by FVC: pixels of the colours that it holds
  std::vector<FvcFigures> figures_;  ///< by FVC
};

}  // namespace tilepress
